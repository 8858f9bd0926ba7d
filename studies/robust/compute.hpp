#pragma once

#include <functional>
#include <string>

#include "studies/robust/results.hpp"

namespace dovetail::robust {

struct ComputeOptions {
  int samples = 200;  ///< of a Sobol sequence, that no search looked at
  std::vector<double> forces_n{1, 2, 3, 4, 5, 6, 7};
  bool bars = true;
  int evaluations = 0;  ///< of either search; 0: as the study says
  std::function<void(const std::string&)> progress;
};

/// Searches the nominal and the robust optimum of a study, as `dovetail run` does, into folders `nominal` and `robust`,
/// and looks at both and at the start. Throws InputError for a wrong study.
[[nodiscard]] Results compute(const std::string& study_file, const std::string& folder, const ComputeOptions& options);

}  // namespace dovetail::robust
