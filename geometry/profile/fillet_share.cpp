#include "geometry/profile/fillet_share.hpp"

#include <algorithm>
#include <cmath>

namespace dovetail::geometry {

double fillet_share(double distance_in_radii) {
  constexpr FilletShareParams kParams = {};
  const double t = std::clamp((distance_in_radii - kParams.from) / (kParams.to - kParams.from), 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

Eigen::VectorXd fillet_shares(const Edge& fillet, bool flank_at_start, double straight, const Eigen::Matrix2Xd& nodes) {
  const Eigen::Vector2d first = (flank_at_start ? fillet.start : fillet.end) - fillet.center;
  Eigen::VectorXd shares(nodes.cols());
  for (Eigen::Index k = 0; k < nodes.cols(); ++k) {
    const Eigen::Vector2d here = nodes.col(k) - fillet.center;
    const double angle = std::atan2(std::abs(first.x() * here.y() - first.y() * here.x()), first.dot(here));
    shares[k] = fillet_share(straight / fillet.radius + angle);
  }
  return shares;
}

}  // namespace dovetail::geometry
