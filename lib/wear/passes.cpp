#include "wear/passes.hpp"

#include <algorithm>
#include <utility>

#include "wear/archard.hpp"

namespace dovetail::wear {

using Eigen::Index;

namespace {

std::vector<bool> loaded_nodes(const response::SteadyState& state, const std::vector<bool>& released) {
  std::vector<bool> loaded(released.size());
  for (std::size_t i = 0; i < loaded.size(); ++i) loaded[i] = !released[i] && state.nodes[i].carries_load;
  return loaded;
}

}  // namespace

Passes::Passes(Index nodes) : released(static_cast<std::size_t>(nodes), false) {}

Ending release_slipping(Release& release, double threshold, int limit, const Control& control, Passes& passes) {
  for (;; ++passes.count) {
    const std::vector<bool> loaded = loaded_nodes(passes.state, passes.released);
    std::vector<bool> next = passes.released;
    bool slipping = false;
    bool held = false;
    for (std::size_t i = 0; i < next.size(); ++i) {
      if (!loaded[i]) continue;
      const bool slips = passes.state.wear_rate[static_cast<Index>(i)] > threshold;
      if (slips)
        next[i] = slipping = true;
      else
        held = true;
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
    const Eigen::VectorXd depth = release.depth(passes.released, passes.state);
    passes.deepest = passes.deepest.size() == 0 ? depth : Eigen::VectorXd(passes.deepest.cwiseMax(depth));
    control.report(passes.count + 1, worn_volume(release.model().contact(), depth), passes.state.wear_rate.maxCoeff());
  }
}

std::optional<Eigen::VectorXd> release_worst_first(Release& release, const response::SteadyState& unworn,
                                                   double threshold) {
  response::SteadyState state = unworn;
  std::vector<bool> released(static_cast<std::size_t>(release.model().nodes()), false);
  for (;;) {
    const std::vector<bool> loaded = loaded_nodes(state, released);
    std::size_t worst = released.size();
    for (std::size_t i = 0; i < released.size(); ++i) {
      const auto rate = [&state](std::size_t node) { return state.wear_rate[static_cast<Index>(node)]; };
      if (loaded[i] && rate(i) > threshold && (worst == released.size() || rate(i) > rate(worst))) worst = i;
    }
    if (worst == released.size()) return release.depth(released, state);
    released[worst] = true;
    state = release.solve(released, state.displacement, true);
    if (state.status != Status::converged) return std::nullopt;
  }
}

}  // namespace dovetail::wear
