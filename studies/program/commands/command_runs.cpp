#include <ostream>

#include "core/replace_file.hpp"
#include "studies/program/commands/commands.hpp"
#include "studies/program/run/run_comparison.hpp"

namespace dovetail::studies {

int run_runs(const RunsOptions& options, const Streams& streams) {
  for (const std::string& file : {options.csv, options.json})
    if (!file.empty() && file != "-") check_replaceable(file);
  std::vector<ComparedRun> runs;
  for (const std::string& directory : options.directories)
    for (const std::filesystem::path& run : runs_in(directory)) runs.push_back(compared(run));
  if (!options.csv.empty()) deliver_json(options.csv, comparison_csv(runs), streams);
  deliver_json(options.json, comparison_json(runs), streams);
  if (options.json != "-" && options.csv != "-") streams.out << comparison_table(runs);
  return kDone;
}

}  // namespace dovetail::studies
