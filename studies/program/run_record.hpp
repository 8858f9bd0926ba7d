#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "optimizer/run.hpp"
#include "studies/program/study.hpp"

namespace dovetail::studies {

/// A run as the results file and the report tell it.
struct RunRecord {
  const Study& study;
  const optimizer::OptimizationResult& result;
  double seconds = 0;   ///< of this call; evaluations from the journal cost nothing
  std::string version;  ///< of the program
};

/// What writes a finished or interrupted run into its directory. Empty members are left out.
struct RunWriters {
  std::function<void(const RunRecord&, const std::filesystem::path& directory)> results;  ///< results.h5
  std::function<void(const RunRecord&, const std::filesystem::path& directory)> report;   ///< report.html
};

/// The writers of this program.
[[nodiscard]] RunWriters run_writers();

}  // namespace dovetail::studies
