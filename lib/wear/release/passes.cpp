#include "wear/release/passes.hpp"

#include <algorithm>
#include <utility>

#include "wear/measures.hpp"
#include "wear/params.hpp"
#include "wear/release/friction_reserve.hpp"

namespace dovetail::wear {

using Eigen::Index;

namespace {

std::vector<bool> loaded_nodes(const steady::State& state, const std::vector<bool>& released) {
  std::vector<bool> loaded(released.size());
  for (std::size_t i = 0; i < loaded.size(); ++i) loaded[i] = !released[i] && state.nodes[i].carries_load;
  return loaded;
}

}  // namespace

Passes::Passes(Index nodes) : released(static_cast<std::size_t>(nodes), false), touching(released) {
  trail.released_in.assign(released.size(), -1);
}

std::vector<bool> wear_off(const steady::State& state, const std::vector<bool>& done, double threshold) {
  double fastest = 0.0;
  for (std::size_t i = 0; i < done.size(); ++i)
    if (!done[i]) fastest = std::max(fastest, state.nodes[i].wear_rate);
  std::vector<bool> off(done.size());
  for (std::size_t i = 0; i < off.size(); ++i) {
    const steady::NodeSummary& node = state.nodes[i];
    off[i] = !done[i] && node.carries_load && node.wear_rate > threshold &&
             !(node.separates && node.wear_rate < ReleaseParams{}.waits * fastest);
  }
  return off;
}

Ending release_slipping(WearingJoint& joint, double threshold, int limit, const Watcher& watcher, Passes& passes) {
  for (;; ++passes.count) {
    const std::vector<bool> loaded = loaded_nodes(passes.state, passes.released);
    const std::vector<bool> slips = wear_off(passes.state, passes.released, threshold);
    std::vector<bool> next = passes.released;
    bool slipping = false;
    bool held = false;
    for (std::size_t i = 0; i < next.size(); ++i) {
      if (slips[i]) next[i] = slipping = true;
      held = held || (loaded[i] && !slips[i]);
    }
    if (!slipping) return Ending::settled;
    if (passes.count >= limit) {
      passes.status = Status::iteration_limit;
      return Ending::failed;
    }
    steady::State state = joint.released(next, passes.state.displacement, !held);
    if (state.status != Status::converged) {
      passes.status = state.status;
      return held || cut_short(state.status) ? Ending::failed : Ending::nothing_holds;
    }
    passes.trail.reserves.push_back(friction_reserve(joint.model(), passes.state, slips));
    for (std::size_t i = 0; i < next.size(); ++i) {
      if (!next[i] || passes.released[i]) continue;
      passes.trail.released_in[i] = static_cast<int>(passes.trail.reserves.size()) - 1;
      if (passes.state.nodes[i].separates) passes.touching[i] = true;
    }
    passes.released = std::move(next);
    passes.state = std::move(state);
    const Eigen::VectorXd depth = joint.depth(passes.released, passes.state);
    passes.deepest = passes.deepest.size() == 0 ? depth : Eigen::VectorXd(passes.deepest.cwiseMax(depth));
    watcher.report(passes.count + 1, worn_volume(joint.model().contact(), depth), passes.state.wear_rate.maxCoeff());
  }
}

SlowRelease release_slowly(WearingJoint& joint, const steady::State& unworn, double threshold, int limit) {
  steady::State state = unworn;
  std::vector<bool> released(static_cast<std::size_t>(joint.model().nodes()), false);
  SlowRelease slow;
  slow.depth = slow.deepest = joint.depth(released, state);
  for (int pass = 0; pass <= limit; ++pass) {
    const std::vector<bool> loaded = loaded_nodes(state, released);
    double fastest = 0.0;
    for (std::size_t i = 0; i < loaded.size(); ++i)
      if (loaded[i]) fastest = std::max(fastest, state.wear_rate[static_cast<Index>(i)]);
    if (fastest <= threshold) {
      slow.settled = true;
      return slow;
    }
    for (std::size_t i = 0; i < loaded.size(); ++i)
      if (loaded[i] &&
          state.wear_rate[static_cast<Index>(i)] >= std::max(threshold, ReleaseParams{}.slow_share * fastest))
        released[i] = true;
    state = joint.released(released, state.displacement, true);
    if (state.status != Status::converged) return slow;
    slow.depth = joint.depth(released, state);
    slow.deepest = slow.deepest.cwiseMax(slow.depth);
  }
  return slow;
}

}  // namespace dovetail::wear
