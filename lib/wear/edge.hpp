#pragma once

#include <Eigen/Core>
#include <functional>
#include <optional>
#include <vector>

#include "reduction/reduced_model.hpp"

namespace dovetail::wear {

/// One end of the worn zone on a flank: a released node e next to a node k that carries load and sticks.
///
/// In the continuum the zone ends where the friction margin of the stuck side reaches zero. Held stuck with the rest
/// released, e would need `excess` more friction than there is; k with e released has `margin` left. The zero in
/// between is at theta = excess / (excess + margin) of the way from e to k. When k joins the zone its margin is zero,
/// theta = 1; seen from the new set its own excess is zero, theta = 0, in the same state: the answer passes the node
/// continuously.
struct Edge {
  int worn = -1;      ///< e
  int stuck = -1;     ///< k
  double excess = 0;  ///< max_t |lambda_T| / (mu lambda_N) - 1 of e while held, >= 0
  double margin = 0;  ///< min_t 1 - |lambda_T| / (mu lambda_N) of k, >= 0
  double theta = 1;   ///< 0: e has only just joined the worn zone; 1: k is about to join

  void place() { theta = excess + margin > 0 ? excess / (excess + margin) : 1.0; }
};

/// Neighbours of every node along its flank: nodes of one group ordered by their place on the flank's longest
/// direction (by index where positions are missing). Plane models only; [Nc] pairs {previous, next}, -1 at ends.
[[nodiscard]] Eigen::MatrixX2i flank_neighbours(const reduction::ContactNodes& contact);

/// Edges between `released` nodes and neighbours that are loaded and not released, one per released node (towards the
/// neighbour with the smaller margin). `margin` [Nc] is the smallest friction margin met; excess and theta are left.
[[nodiscard]] std::vector<Edge> find_edges(const reduction::ContactNodes& contact, const std::vector<bool>& released,
                                           const std::vector<bool>& loaded, const Eigen::VectorXd& margin);

/// Depths with every edge at its theta, from states in which some of the edge nodes are still stuck.
///
/// `depth_without(S)` gives the depths [Nc] with the edge nodes of the set S (flags, one per edge) held stuck instead
/// of released; empty when that state could not be computed. Up to `tensor_edges` edges all 2^n states are combined
/// multilinearly, so the answer is continuous when one edge passes a node whatever the others do; beyond that the
/// states with one edge held back are added up, which leaves the edges' interaction out.
[[nodiscard]] std::optional<Eigen::VectorXd> interpolate_edges(
    const std::vector<Edge>& edges, const Eigen::VectorXd& released_depth, int tensor_edges,
    const std::function<std::optional<Eigen::VectorXd>(const std::vector<bool>&)>& depth_without);

}  // namespace dovetail::wear
