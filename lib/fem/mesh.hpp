#pragma once

#include <Eigen/Core>
#include <cassert>
#include <span>
#include <string>
#include <vector>

#include "fem/elements/element_kind.hpp"

namespace dovetail::fem {

/// A part of the body with one material and, in the plane, one thickness.
struct Region {
  std::string name;           ///< "blade_root", "aerofoil", "disk"
  int body = 0;               ///< 0 blade, 1 disk: index into the list of materials
  double thickness = 1.0;     ///< m, > 0; counts in the plane only
  bool plane_stress = false;  ///< false: plane strain; counts in the plane only
};

/// Quadratic isoparametric mesh in the plane or in space. Curved edges carry their mid-side node on the true curve.
struct Mesh {
  ElementKind kind = ElementKind::triangle6;
  Eigen::MatrixXd nodes;          ///< [d, n] positions, m
  std::vector<int> connectivity;  ///< node indices, nodes_per_element() for every element in a row
  std::vector<int> region;        ///< [elements] index into `regions`
  std::vector<Region> regions;

  [[nodiscard]] int dimensions() const { return fem::dimensions(kind); }
  [[nodiscard]] int nodes_per_element() const { return fem::nodes_per_element(kind); }
  [[nodiscard]] int node_count() const { return static_cast<int>(nodes.cols()); }
  [[nodiscard]] int element_count() const { return static_cast<int>(connectivity.size()) / nodes_per_element(); }

  /// Nodes of an element.
  [[nodiscard]] std::span<const int> element(int e) const {
    assert(e >= 0 && e < element_count());
    const std::size_t count = static_cast<std::size_t>(nodes_per_element());
    return std::span<const int>(connectivity).subspan(static_cast<std::size_t>(e) * count, count);
  }
  [[nodiscard]] const Region& region_of(int e) const {
    return regions[static_cast<std::size_t>(region[static_cast<std::size_t>(e)])];
  }
};

}  // namespace dovetail::fem
