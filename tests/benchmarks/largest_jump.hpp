#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace dovetail {

/// How far values at equal distances are from those of a smooth curve: max |third difference| / 2 relative to the
/// largest of them. A step of height s gives s, a smooth curve something that falls with the third power of the
/// spacing.
inline double largest_jump(const std::vector<double>& y) {
  double jump = 0, size = 0;
  for (std::size_t i = 0; i < y.size(); ++i) {
    size = std::max(size, std::abs(y[i]));
    if (i >= 3) jump = std::max(jump, std::abs(y[i] - 3 * y[i - 1] + 3 * y[i - 2] - y[i - 3]) / 2);
  }
  return size > 0 ? jump / size : 0;
}

}  // namespace dovetail
