#include "geometry/mesh_quality.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace dovetail::geometry {
namespace {

using Eigen::Vector2d;
using Gradient = Eigen::Matrix<double, 6, 2>;

/// Derivatives of the six-node shape functions by the area coordinates (L2, L3).
Gradient gradient(double r, double s) {
  const double t = 1 - r - s;
  Gradient g;
  g << 1 - 4 * t, 1 - 4 * t, 4 * r - 1, 0, 0, 4 * s - 1, 4 * (t - r), -4 * r, 4 * s, 4 * r, -4 * s, 4 * (t - s);
  return g;
}

std::array<Gradient, 13> sample_gradients() {
  const double root = std::sqrt(15.0), a = (6 - root) / 21, b = (6 + root) / 21;
  return {gradient(1.0 / 3, 1.0 / 3),
          gradient(a, a),
          gradient(1 - 2 * a, a),
          gradient(a, 1 - 2 * a),
          gradient(b, b),
          gradient(1 - 2 * b, b),
          gradient(b, 1 - 2 * b),
          gradient(0, 0),
          gradient(1, 0),
          gradient(0, 1),
          gradient(0.5, 0),
          gradient(0.5, 0.5),
          gradient(0, 0.5)};
}

}  // namespace

MeshQuality assess(const fem::Mesh& mesh) {
  static const std::array<Gradient, 13> samples = sample_gradients();
  MeshQuality quality{.minimum_scaled_jacobian = std::numeric_limits<double>::infinity(),
                      .minimum_angle = std::numbers::pi,
                      .maximum_angle = 0};
  for (int e = 0; e < mesh.element_count(); ++e) {
    Eigen::Matrix<double, 2, 6> x;
    for (int i = 0; i < 6; ++i)
      x.col(i) = mesh.nodes.col(mesh.elements[static_cast<std::size_t>(e)][static_cast<std::size_t>(i)]);
    double smallest = std::numeric_limits<double>::infinity();
    for (const Gradient& g : samples) {
      const Eigen::Matrix2d jacobian = x * g;
      smallest = std::min(smallest, jacobian(0, 0) * jacobian(1, 1) - jacobian(0, 1) * jacobian(1, 0));
    }
    const Vector2d u = x.col(1) - x.col(0), v = x.col(2) - x.col(1), w = x.col(0) - x.col(2);
    std::array<double, 3> lengths{u.norm(), v.norm(), w.norm()};
    std::sort(lengths.begin(), lengths.end());
    const double scaled = 2 / std::numbers::sqrt3 * smallest / (lengths[1] * lengths[2]);
    // Written so that a NaN counts as inverted.
    if (!(smallest > 0)) ++quality.inverted_elements;
    if (!(scaled >= quality.minimum_scaled_jacobian)) {
      quality.minimum_scaled_jacobian = scaled;
      quality.worst_element = e;
    }
    for (const auto& [from, to] : {std::pair{w, u}, std::pair{u, v}, std::pair{v, w}}) {
      const double angle = std::atan2(-from.x() * to.y() + from.y() * to.x(), -from.dot(to));
      const double inner = std::abs(angle);
      quality.minimum_angle = std::min(quality.minimum_angle, inner);
      quality.maximum_angle = std::max(quality.maximum_angle, inner);
    }
  }
  return quality;
}

bool acceptable(const MeshQuality& quality, const MeshLimits& limits) {
  return quality.inverted_elements == 0 && quality.minimum_scaled_jacobian >= limits.minimum_scaled_jacobian &&
         quality.minimum_angle >= limits.minimum_angle;
}

}  // namespace dovetail::geometry
