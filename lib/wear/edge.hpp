#pragma once

#include <Eigen/Core>
#include <vector>

#include "reduction/reduced_model.hpp"

namespace dovetail::wear {

/// One end of the worn zone on a flank: a released node e next to a node k that carries load and sticks.
///
/// In the continuum the zone ends where the friction margin of the stuck side reaches zero. Held stuck with the rest
/// released, e would need `excess` more friction than there is; k with e released has `margin` left. The zero in
/// between is at theta = excess / (excess + margin) of the way from e to k. When k joins the zone its margin is zero,
/// theta = 1; seen from the new set its own excess is zero, theta = 0, in the same state: the edge passes the node
/// continuously.
///
/// The state with e released has the nodal pressures end half a node beyond k. Quadratic B-splines over the three
/// states "e held", "as found" and "k released as well" put the edge where theta says, to second order in the node
/// spacing, and continue each other in value and slope when the set changes.
struct Edge {
  int worn = -1;      ///< e
  int stuck = -1;     ///< k
  double excess = 0;  ///< minus the friction margin of e while held, >= 0
  double margin = 0;  ///< friction margin of k, >= 0
  double theta = 1;   ///< 0: e has only just joined the worn zone; 1: k is about to join

  void place() { theta = excess + margin > 0 ? excess / (excess + margin) : 1.0; }
  [[nodiscard]] double held_weight() const { return 0.5 * (1.0 - theta) * (1.0 - theta); }
  [[nodiscard]] double next_weight() const { return 0.5 * theta * theta; }
};

/// Neighbours of every node along its flank: nodes of one group ordered by their place on the flank's longest
/// direction (by index where positions are missing). Plane models only; [Nc] pairs {previous, next}, -1 at ends.
[[nodiscard]] Eigen::MatrixX2i flank_neighbours(const reduction::ContactNodes& contact);

/// Edges between `released` nodes and neighbours that are loaded and not released, one per released node (towards the
/// neighbour with the smaller margin). `margin` [Nc] is the smallest friction margin met; excess and theta are left.
[[nodiscard]] std::vector<Edge> find_edges(const reduction::ContactNodes& contact, const std::vector<bool>& released,
                                           const std::vector<bool>& loaded, const Eigen::VectorXd& margin);

/// Depths [Nc] of the states next to the one found, for one edge.
struct EdgeStates {
  Eigen::VectorXd held;  ///< the worn node held stuck instead of released
  Eigen::VectorXd next;  ///< the stuck node released as well
};

/// Depths with every edge at its theta, W + sum_edges w_held (W_held - W) + w_next (W_next - W), not below zero; the
/// interaction of edges is left out. `states` has one entry per edge.
[[nodiscard]] Eigen::VectorXd interpolate_edges(const std::vector<Edge>& edges, const Eigen::VectorXd& found,
                                                const std::vector<EdgeStates>& states);

}  // namespace dovetail::wear
