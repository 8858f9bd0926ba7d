#pragma once

#include <vector>

#include "geometry/cad/worn_flank.hpp"
#include "geometry/solid/solid_flank.hpp"

namespace dovetail::geometry {

/// How far a blade's flank lies behind the nominal one, along its normal: its form and its wear,
///
///   d(s, u) = g(s, u) + w(s, u),
///
/// g that of SolidFlankForm. On a line across the flank w goes through the depths given by cubics that rise and fall
/// with them [Fritsch & Carlson 1980], constant beyond the first and the last place; between two lines it passes from
/// one into the other with the weight 3 t^2 - 2 t^3, beyond the first and the last it is theirs. So w is nowhere
/// deeper or shallower than the depths around, and d has continuous slopes and is one bicubic between the knots.
class FlankDepth {
 public:
  FlankDepth(const SolidFlankForm& form, WornFlank worn);

  struct Value {
    double depth = 0, by_s = 0, by_u = 0, by_su = 0;  ///< m; derivatives by s, u and both
  };
  [[nodiscard]] Value at(double s, double u) const;

  /// Where pieces join, from 0 to 1.
  [[nodiscard]] const std::vector<double>& across() const { return across_; }
  [[nodiscard]] const std::vector<double>& along() const { return along_; }
  [[nodiscard]] bool same_along_slot() const { return along_.size() == 2; }

 private:
  /// Depth and slope on a line.
  [[nodiscard]] static Value on_line(const WornLine& line, const std::vector<double>& slopes, double s);

  SolidFlankForm form_;
  WornFlank worn_;
  std::vector<std::vector<double>> slopes_;  // of every line at its places
  std::vector<double> across_, along_;
};

}  // namespace dovetail::geometry
