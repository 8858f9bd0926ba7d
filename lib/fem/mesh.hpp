#pragma once

#include <Eigen/Core>
#include <array>
#include <string>
#include <vector>

namespace dovetail::fem {

/// A part of the section with one material and one thickness out of the plane.
struct Region {
  std::string name;           ///< "blade_root", "aerofoil", "disk"
  int body = 0;               ///< 0 blade, 1 disk: index into the list of materials
  double thickness = 1.0;     ///< m, > 0
  bool plane_stress = false;  ///< false: plane strain
};

/// Plane mesh of six-node triangles: corners 0,1,2 counter-clockwise, then the mid-side nodes of the
/// edges 01, 12, 20. Curved edges carry their mid-side node on the true curve.
struct Mesh {
  Eigen::Matrix2Xd nodes;                    ///< [2, n] positions, m
  std::vector<std::array<int, 6>> elements;  ///< node indices
  std::vector<int> region;                   ///< [elements] index into `regions`
  std::vector<Region> regions;

  [[nodiscard]] int node_count() const { return static_cast<int>(nodes.cols()); }
  [[nodiscard]] int element_count() const { return static_cast<int>(elements.size()); }
};

}  // namespace dovetail::fem
