#pragma once

#include <functional>
#include <string>
#include <vector>

#include "studies/work_precision/newton_step.hpp"

namespace dovetail::work_precision {

/// A Newton step measured over one size, the others fixed.
struct Growth {
  std::string key, title;    ///< "nodes", "harmonics" or "samples"
  std::string fixed;         ///< "3 harmonics, 128 samples"
  std::vector<double> size;  ///< of what grows
  std::vector<StepTimes> times;
};

/// Nodes 25 to 200, harmonics 1 to 31 and samples 64 to 4096 on contact patches half of whose nodes stay stuck; `quick`
/// takes small ones. `progress` is told what comes.
[[nodiscard]] std::vector<Growth> measure_growth(bool quick, const std::function<void(const std::string&)>& progress);

/// The exponent p of seconds ~ size^p between the last two sizes.
[[nodiscard]] double exponent(const Growth& growth, double StepTimes::*part);

}  // namespace dovetail::work_precision
