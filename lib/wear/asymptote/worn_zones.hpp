#pragma once

/// @file
/// How much of an answer hangs on where, within a contact node, its zones end. A wear history wears off whole nodes,
/// the direct method ends worn zones where friction just holds; before any wear, zones that slip end somewhere in a
/// node.
#include <Eigen/Core>
#include <span>
#include <vector>

#include "wear/node_line.hpp"

namespace dovetail::wear {

struct WornChange {
  double volume = 0, depth = 0;  ///< m^3, m
};

/// What a part of the width of a worn zone changes at most: the depth grows like its power 3/2, the volume like 5/2.
[[nodiscard]] WornChange width_changed_by(double share, const WornChange& zone);

// `area` [Nc] m^2 of the nodes. Ends of zones are looked for along lines; a node on none changes nothing here.

/// What a part of a node at the end of every zone of `worn` nodes changes at most. The ends of a line are no ends of a
/// zone: nothing is beyond them.
[[nodiscard]] WornChange ends_moved_by(double part, std::span<const NodeLine> lines, const Eigen::VectorXd& area,
                                       const std::vector<bool>& worn, const Eigen::VectorXd& depth);

/// Whether two worn volumes differ by more than the nodes at the ends of zones may decide.
[[nodiscard]] bool far_apart(const Eigen::VectorXd& area, const Eigen::VectorXd& one, const Eigen::VectorXd& other);

/// Whether two worn shapes differ by a node at the ends of their zones, and by no more wear than such nodes explain: a
/// history cannot tell such shapes apart.
[[nodiscard]] bool a_node_apart(std::span<const NodeLine> lines, const Eigen::VectorXd& area,
                                const Eigen::VectorXd& one, const Eigen::VectorXd& other);

/// What the nodes at the ends of slipping zones leave open of the energy (J per cycle, by node) where such a zone is a
/// node or two wide. `loaded`: whether a node carries load; a zone that ends at an open node ends there on any nodes.
[[nodiscard]] double energy_left_open(std::span<const NodeLine> lines, const Eigen::VectorXd& area,
                                      const Eigen::VectorXd& energy, const std::vector<bool>& loaded);

}  // namespace dovetail::wear
