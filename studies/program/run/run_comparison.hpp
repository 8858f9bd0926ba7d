#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace dovetail::studies {

/// What a run came to, as it is compared with others.
struct ComparedRun {
  std::string directory, name;
  std::string status;  ///< of the search; "unfinished" where it has no results yet
  int evaluations = 0, feasible = 0, failed = 0;
  std::optional<int> best;                       ///< number of the best feasible evaluation, from 1
  std::optional<double> objective, start;        ///< of the best one, and of the start; of a front its first one
  std::map<std::string, double> variables = {};  ///< of the best one by key, in the file's unit
  std::map<std::string, double> responses = {};  ///< of the best one, SI
  double seconds = 0;                            ///< of all its sessions
};

/// Runs in a directory: itself, or all below it, by name. Throws InputError where there is none.
[[nodiscard]] std::vector<std::filesystem::path> runs_in(const std::string& directory);

/// Of a run with results, or with a journal alone; of one that cannot be read the status "damaged".
[[nodiscard]] ComparedRun compared(const std::filesystem::path& directory);

/// One run a line, and below the variables of their best designs side by side.
[[nodiscard]] std::string comparison_table(const std::vector<ComparedRun>& runs);
/// One run a line: what the table has, all variables and responses of the best designs.
[[nodiscard]] std::string comparison_csv(const std::vector<ComparedRun>& runs);
/// {"version", "runs": [{"directory", "name", "status", "evaluations", "feasible", "failed", "best", "objective",
/// "start", "variables", "responses", "seconds"}]}
[[nodiscard]] std::string comparison_json(const std::vector<ComparedRun>& runs);

}  // namespace dovetail::studies
