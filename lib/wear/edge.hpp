#pragma once

#include <Eigen/Core>
#include <functional>
#include <optional>
#include <vector>

#include "reduction/reduced_model.hpp"

namespace dovetail::wear {

/// One end of the worn zone on a flank: a released node next to a node that carries load and sticks.
struct Edge {
  int worn = -1;      ///< released node e
  int stuck = -1;     ///< its neighbour k
  double excess = 0;  ///< how far e was beyond sticking when it was released, >= 0, in units of mu lambda_N
  double margin = 0;  ///< how far k is from slipping, min_t (mu lambda_N - |lambda_T|) / (mu max_t lambda_N) >= 0
  double theta = 1;   ///< 0: e has only just joined the worn zone; 1: k is about to join
};

/// Neighbours of every node along its flank: nodes of one group ordered by their place on the flank's longest
/// direction (by index where positions are missing). Plane models only; [Nc] pairs {previous, next}, -1 at ends.
[[nodiscard]] Eigen::MatrixX2i flank_neighbours(const reduction::ContactNodes& contact);

/// Edges between `released` nodes and neighbours that are loaded and not released, one per released node (towards
/// the neighbour with the smaller margin). `score` [Nc] is the signed margin: >= 0 smallest friction margin seen,
/// < 0 minus the excess. theta = excess / (excess + margin).
[[nodiscard]] std::vector<Edge> find_edges(const reduction::ContactNodes& contact, const std::vector<bool>& released,
                                           const std::vector<bool>& loaded, const Eigen::VectorXd& score);

/// Depths with every edge at its theta, from states in which some of the edge nodes are still stuck.
///
/// `depth_without(S)` gives the depths [Nc] with the edge nodes of the set S (flags, one per edge) not released; empty
/// when that state could not be computed. Up to `tensor_edges` edges all 2^n states are combined multilinearly,
/// so the answer is continuous when one edge passes a node whatever the others do; beyond that the states with
/// one edge held back are added up, which leaves the edges' interaction out.
[[nodiscard]] std::optional<Eigen::VectorXd> interpolate_edges(
    const std::vector<Edge>& edges, const Eigen::VectorXd& released_depth, int tensor_edges,
    const std::function<std::optional<Eigen::VectorXd>(const std::vector<bool>&)>& depth_without);

}  // namespace dovetail::wear
