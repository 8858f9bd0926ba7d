#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "studies/work_precision/evaluations/points.hpp"
#include "studies/work_precision/growth.hpp"
#include "studies/work_precision/sweep.hpp"

namespace dovetail::work_precision {

/// Where and from what the figures were made.
struct Circumstances {
  std::string commit;   ///< of the sources; with "+" when they were changed
  std::string machine;  ///< processor, cores, memory
  std::string system;   ///< kernel and distribution
  std::string blas;     ///< OpenBLAS with the kernels it chose
  std::string compiler, date_utc;
  double seconds = 0;  ///< of the whole study, wall clock
  bool quick = false;
};

/// Machine, system, compiler, libraries and date; commit and seconds are the caller's.
[[nodiscard]] Circumstances circumstances();

struct Results {
  std::vector<Diagram> diagrams;
  std::vector<Growth> growth;
  std::vector<WholeDiagram> evaluations = {};  ///< of whole evaluations, a design each
  Circumstances made;
};

/// The error every one of the three quantities should stay below: what the defaults are judged by.
inline constexpr double kGoal = 0.01;

/// Every point as one row; numbers with 17 digits, empty where a run failed.
[[nodiscard]] std::string table_csv(const Results& results);
[[nodiscard]] std::string growth_csv(const Results& results);
/// The same with references, verdicts and circumstances.
[[nodiscard]] std::string table_json(const Results& results);
/// The self-contained page.
[[nodiscard]] std::string page_html(const Results& results);

/// table.csv, growth.csv, evaluations.csv, table.json and index.html in `folder`, made if needed. Throws InputError
/// when it cannot.
void write(const std::filesystem::path& folder, const Results& results);

}  // namespace dovetail::work_precision
