#pragma once

#include <vector>

namespace dovetail::geometry {

/// Wear depths on a line across a flank, from its neck to its root side.
struct WornLine {
  double along = 0.5;               ///< place of the line along the slot, from 0 (lowest z) to 1
  std::vector<double> places = {};  ///< rising, fractions of the flank's length from its neck-side end
  std::vector<double> depth = {};   ///< m, >= 0, at these places
};

/// Lines with rising `along`; none: unworn. A plane section has one.
using WornFlank = std::vector<WornLine>;

}  // namespace dovetail::geometry
