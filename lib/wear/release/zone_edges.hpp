#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "wear/node_line.hpp"

namespace dovetail::wear {

/// What the passes of release saw on their way, for finding where between two nodes a worn zone ends.
struct ReleaseTrail {
  std::vector<int> released_in;           ///< [Nc] pass that released the node, from 0; -1: none
  std::vector<Eigen::VectorXd> reserves;  ///< per pass [Nc]: `friction_reserve` of the state before it
};

/// A place on a line of nodes where a worn zone ends: between a worn node and the one that bears next to it. Where the
/// last pass that moved the end found a zone there already, it lies as far beyond the old end as the fraction says.
struct ZoneEdge {
  int line = 0;
  int worn = 0, bearing = 0;  ///< nodes
  double fraction = 0;        ///< of the way from the worn node's middle to the bearing one's
  int first = 0;              ///< of the run of nodes that ends with `worn` and that one pass released
  int before = -1;            ///< node next to `first` that an earlier pass released, or -1
};

/// Ends of the worn zones along lines of neighbouring nodes. In the continuum a zone ends where the reserve of friction
/// vanishes; between the worn node and the bearing one the reserve of the pass that released the first is interpolated
/// linearly. `size` [Nc]: lengths or areas of the nodes. An end beside a node without load is no edge: there the flanks
/// are apart.
[[nodiscard]] std::vector<ZoneEdge> zone_edges(const ReleaseTrail& trail, std::span<const NodeLine> lines,
                                               const Eigen::VectorXd& size);

}  // namespace dovetail::wear
