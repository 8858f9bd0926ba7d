#pragma once

#include <string>
#include <vector>

namespace dovetail::report {

/// Marks of an axis.
struct Ticks {
  double lower = 0, upper = 1;  ///< range of the axis
  std::vector<double> at;       ///< within it, ascending
  std::vector<std::string> labels;
};

/// Multiples of 1, 2, 2.5 or 5 times a power of ten, about `count` of them, covering [lower, upper]; the range is
/// widened to whole ticks unless `tight`. lower == upper widens to something around it. Labels all have as many
/// decimals as the step needs, with a true minus sign.
[[nodiscard]] Ticks linear_ticks(double lower, double upper, int count, bool tight = false);

/// Powers of ten covering [lower, upper], 0 < lower; with few decades also 2 and 5 times them.
[[nodiscard]] Ticks logarithmic_ticks(double lower, double upper);

}  // namespace dovetail::report
