#pragma once

#include <Eigen/Core>
#include <vector>

#include "wear/edge.hpp"
#include "wear/release.hpp"

namespace dovetail::wear {

/// How the passes of release ended.
enum class Ending {
  settled,        ///< no loaded node slips
  nothing_holds,  ///< every loaded node slips, and nothing else takes the load over
  failed,         ///< a steady state did not converge, or the passes were used up: see `status`
};

/// What the passes of release know about the nodes.
struct Passes {
  explicit Passes(Eigen::Index nodes);

  std::vector<bool> released;   ///< [Nc]
  Eigen::VectorXd margin;       ///< [Nc] smallest friction margin met, of nodes in the passes in which they stuck
  Eigen::VectorXd excess;       ///< [Nc] overload relieved by slip in the pass that released the node
  response::SteadyState state;  ///< with `released`
  int count = 0;                ///< passes done
  Status status = Status::converged;
};

/// Releases every loaded node that wears by more than `threshold` m per cycle, solves again, and so on, beginning with
/// `passes.state`. At most `limit` passes.
[[nodiscard]] Ending release_slipping(Release& release, double threshold, int limit, const Control& control,
                                      Passes& passes);

/// The edges of the worn zone a settled release found, where they lie between nodes, and the states next to it.
struct PlacedEdges {
  Status status = Status::converged;  ///< otherwise a state next to the one found could not be computed
  std::vector<Edge> edges;
  std::vector<EdgeStates> states;  ///< one per edge when converged
};
[[nodiscard]] PlacedEdges place_edges(Release& release, double threshold, int limit, const Passes& passes);

}  // namespace dovetail::wear
