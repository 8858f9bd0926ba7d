#pragma once

#include "geometry/profile/profile.hpp"

namespace dovetail::geometry {

/// Straight edge.
[[nodiscard]] Edge line(std::string name, const Eigen::Vector2d& start, const Eigen::Vector2d& end);

/// Arc about `center` turning by `sweep` (counter-clockwise positive) from `start` to `end`; the caller gives
/// consistent ends, so that neighbouring edges can share them to the last bit.
[[nodiscard]] Edge arc(std::string name, const Eigen::Vector2d& start, const Eigen::Vector2d& end,
                       const Eigen::Vector2d& center, double sweep);

/// Arc from `start` through `middle` to `end`; the three points must not lie on a line.
[[nodiscard]] Edge arc_through(std::string name, const Eigen::Vector2d& start, const Eigen::Vector2d& middle,
                               const Eigen::Vector2d& end);

/// The same curve travelled the other way.
[[nodiscard]] Edge reversed(const Edge& edge);

/// Mirror image about x = 0, travelled the other way so that material stays on the left.
[[nodiscard]] Chain mirrored(const Chain& chain);

/// An open chain that grows edge by edge.
class ChainBuilder {
 public:
  explicit ChainBuilder(const Eigen::Vector2d& start) : at_(start) {}
  void line_to(std::string name, const Eigen::Vector2d& end);
  void arc_to(std::string name, const Eigen::Vector2d& end, const Eigen::Vector2d& center, double sweep);
  [[nodiscard]] const Chain& chain() const { return chain_; }

 private:
  Eigen::Vector2d at_;
  Chain chain_;
};

}  // namespace dovetail::geometry
