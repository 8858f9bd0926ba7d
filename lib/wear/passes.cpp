#include "wear/passes.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "wear/archard.hpp"

namespace dovetail::wear {

using Eigen::Index;
using Eigen::VectorXd;

namespace {

std::vector<bool> loaded_nodes(const response::SteadyState& state, const std::vector<bool>& released) {
  std::vector<bool> loaded(released.size());
  for (std::size_t i = 0; i < loaded.size(); ++i) loaded[i] = !released[i] && state.nodes[i].carries_load;
  return loaded;
}

}  // namespace

Passes::Passes(Index nodes)
    : released(static_cast<std::size_t>(nodes), false),
      margin(VectorXd::Constant(nodes, std::numeric_limits<double>::infinity())),
      excess(VectorXd::Zero(nodes)) {}

Ending release_slipping(Release& release, double threshold, int limit, const Control& control, Passes& passes) {
  const VectorXd& friction = release.model().contact().friction;
  for (;; ++passes.count) {
    const std::vector<bool> loaded = loaded_nodes(passes.state, passes.released);
    std::vector<bool> next = passes.released;
    bool slipping = false;
    bool held = false;
    for (std::size_t i = 0; i < next.size(); ++i) {
      if (!loaded[i]) continue;
      const auto node = static_cast<Index>(i);
      if (passes.state.wear_rate[node] > threshold) {
        next[i] = slipping = true;
        passes.excess[node] = slip_excess(release.model(), passes.state, node);
      } else {
        held = true;
        passes.margin[node] = std::min(passes.margin[node], friction_margin(passes.state, node, friction[node]));
      }
    }
    if (!slipping) return Ending::settled;
    if (passes.count >= limit) {
      passes.status = Status::iteration_limit;
      return Ending::failed;
    }
    response::SteadyState state = release.solve(next, passes.state.displacement, !held);
    if (state.status != Status::converged) {
      passes.status = state.status;
      return held || state.status == Status::interrupted ? Ending::failed : Ending::nothing_holds;
    }
    passes.released = std::move(next);
    passes.state = std::move(state);
    control.report(passes.count + 1,
                   worn_volume(release.model().contact(), release.depth(passes.released, passes.state)),
                   passes.state.wear_rate.maxCoeff());
  }
}

PlacedEdges place_edges(Release& release, double threshold, int limit, const Passes& passes) {
  const reduction::ContactNodes& contact = release.model().contact();
  const VectorXd found = release.depth(passes.released, passes.state);
  PlacedEdges placed;
  if (contact.directions() != 2) return placed;  // on a surface the edge is a line through many nodes
  placed.edges = find_edges(contact, passes.released, loaded_nodes(passes.state, passes.released), passes.margin);
  // A node released early may not slip once the rest is worn: then the slip that released it counts, scaled well below
  // the excess of a held node (which it overestimates, the node's own stiffness being an upper bound).
  constexpr double kSlipShare = 0.1;
  for (Edge& edge : placed.edges) {
    EdgeStates states;
    std::vector<bool> released = passes.released;
    released[static_cast<std::size_t>(edge.worn)] = false;
    const response::SteadyState held = release.solve_held(released, {edge.worn}, passes.state.displacement);
    if (held.status != Status::converged) {
      placed.status = held.status;
      return placed;
    }
    states.held = release.depth(released, held);
    edge.excess = std::max(
        {0.0, kSlipShare * passes.excess[edge.worn], -friction_margin(held, edge.worn, contact.friction[edge.worn])});
    edge.place();

    Passes beyond = passes;
    beyond.count = 0;
    beyond.released[static_cast<std::size_t>(edge.stuck)] = true;
    beyond.state = release.solve(beyond.released, passes.state.displacement, true);
    const bool settled = beyond.state.status == Status::converged &&
                         release_slipping(release, threshold, limit, {}, beyond) == Ending::settled;
    // Where nothing would hold without k there is no such state: the step between the other two goes on.
    states.next = settled ? release.depth(beyond.released, beyond.state) : VectorXd(2.0 * found - states.held);
    if (release.stopped()) {
      placed.status = Status::interrupted;
      return placed;
    }
    placed.states.push_back(std::move(states));
  }
  return placed;
}

}  // namespace dovetail::wear
