#pragma once

#include <Eigen/Core>
#include <vector>

#include "fem/sector_mesh.hpp"
#include "geometry/mesh/corner_mesh.hpp"

namespace dovetail::geometry {

/// The six-node sector mesh without its positions: everything that does not change while a design moves.
/// Node order: blade corners, blade mid-sides, disk corners, disk mid-sides. Blade and disk share no nodes. Pairs of a
/// flank in order from neck to root side; every second one, from the first on, is a contact node.
class SectorTopology {
 public:
  /// The chains give the names of the edges; their dimensions do not matter.
  SectorTopology(const CornerMesh& blade, const CornerMesh& disk, const Profile& profile);

  /// The mesh of a design whose corner nodes are at these positions. Mid-side nodes lie on the profile's
  /// edges at the middle of the fraction (boundary) or half-way between the corners (interior).
  /// `gap` of the flanks is that of flank_form.hpp at the corner nodes.
  [[nodiscard]] fem::SectorMesh place(const Profile& profile, const ProfileParameters& parameters,
                                      const Eigen::Matrix2Xd& blade_corners,
                                      const Eigen::Matrix2Xd& disk_corners) const;
  /// The positions [2, nodes] alone.
  [[nodiscard]] Eigen::Matrix2Xd positions(const Profile& profile, const Eigen::Matrix2Xd& blade_corners,
                                           const Eigen::Matrix2Xd& disk_corners) const;
  /// Of the contact nodes along either flank, from neck to root.
  [[nodiscard]] const std::vector<double>& flank_fractions() const { return flank_fractions_; }
  /// Values given at the corner nodes of the blade at all nodes: means of the corners at mid-sides, 0 in the disk.
  [[nodiscard]] Eigen::VectorXd blade_values(const Eigen::VectorXd& at_corners) const;

 private:
  struct MiddleNode {
    int node, from, to;  // global numbers
    int edge = -1;       // of the chain; -1: straight
    double fraction = 0;
  };
  struct Body {
    int first = 0;  // global number of corner 0
    int corners = 0;
    std::vector<MiddleNode> middles;
    std::vector<std::vector<int>> along;  // [edges of the chain] corner, middle, corner, ... from start to end
  };

  Body add_body(const CornerMesh& corners, const Chain& chain, int regions_before);
  void add_flank(const FlankPlace& place, const Profile& profile);
  void share_fillets(const Profile& profile, fem::SectorMesh& sector) const;

  Body blade_, disk_;
  int node_count_ = 0;
  std::vector<double> flank_fractions_;  // from neck to root, the same for both flanks
  fem::SectorMesh sector_;               // positions, normals and gaps still empty
};

}  // namespace dovetail::geometry
