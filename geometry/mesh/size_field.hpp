#pragma once

#include <Eigen/Core>
#include <vector>

#include "geometry/profile/parameters.hpp"
#include "geometry/profile/profile.hpp"

namespace dovetail::geometry {

/// Wanted element size over the plane, m: `h(x) = min(h_bulk, min_k h_k + growth |x - x_k|)` over
/// sources k on the boundary. Evaluation costs O(sources).
class SizeField {
 public:
  SizeField(double bulk, double growth) : bulk_(bulk), growth_(growth) {}

  /// Wants the size h at x; without effect where h >= bulk.
  void add_source(const Eigen::Vector2d& x, double h);
  [[nodiscard]] double operator()(const Eigen::Vector2d& x) const;

 private:
  struct Source {
    double x, y, size;
  };
  double bulk_, growth_;
  std::vector<Source> sources_;
};

/// Sizes asked for by one body of the section:
/// - a bearing flank: the lengths of its edges, between the fractions `flank`;
/// - a fillet: fillet_fraction * radius, other arcs twice that: the peak stress sits in the fillets;
/// - a blend (no stress is read there): blend_fraction * radius;
/// - a wall of thickness t, measured along the inward normal of the boundary: t/2, i.e. at least two
///   quadratic elements through every wall;
/// - away from these the size grows by `growth` times the distance up to bulk_size.
[[nodiscard]] SizeField element_sizes(const Chain& chain, const MeshSizes& sizes, const std::vector<double>& flank);

}  // namespace dovetail::geometry
