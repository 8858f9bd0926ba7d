#include "wear/partial_release.hpp"

#include <algorithm>
#include <vector>

#include "wear/flank_lines.hpp"
#include "wear/passes.hpp"
#include "wear/worn_zones.hpp"

namespace dovetail::wear {

using Eigen::Index;
using Eigen::VectorXd;

namespace {

// Shares nearer to an end than this are at it: the springs would be numerically rigid or absent.
constexpr double kEnd = 1e-4;
// Shares that move by less than this have settled: it is far below what the place of an edge is known to.
constexpr double kSettled = 1e-3;

NodeInPass look_at(const Release& release, const response::SteadyState& state, Index i, double share, bool slips) {
  const response::NodeSummary& summary = state.nodes[static_cast<std::size_t>(i)];
  NodeInPass node;
  node.load = summary.max_normal_force;
  node.loaded = share < 1 && summary.carries_load;
  node.slips = node.loaded && slips;
  if (node.slips)
    node.excess = slip_excess(release.model(), state, i);
  else if (node.loaded)
    node.margin = std::max(0.0, friction_margin(state, i, release.model().contact().friction[i]));
  return node;
}

VectorXd rounded(VectorXd share) {
  for (double& part : share) {
    if (part < kEnd) part = 0;
    if (part > 1 - kEnd) part = 1;
  }
  return share;
}

}  // namespace

PartialRelease release_partially(Release& release, const response::SteadyState& unworn, double threshold, int limit) {
  const std::vector<std::vector<int>> lines = flank_lines(release.model().contact());
  std::vector<WornZones> zones;
  for (const std::vector<int>& line : lines) zones.emplace_back(line.size());
  PartialRelease result;
  result.share = VectorXd::Zero(release.model().nodes());
  result.state = unworn;
  for (result.passes = 0; result.passes < limit; ++result.passes) {
    VectorXd share = result.share;
    // What happens inside the zones holds nothing up.
    std::vector<bool> inside(static_cast<std::size_t>(share.size()));
    for (Index i = 0; i < share.size(); ++i) inside[static_cast<std::size_t>(i)] = share[i] >= 0.5;
    const std::vector<bool> slips = wear_off(result.state, inside, threshold);
    for (std::size_t l = 0; l < lines.size(); ++l) {
      std::vector<NodeInPass> nodes;
      for (const int i : lines[l])
        nodes.push_back(look_at(release, result.state, i, result.share[i], slips[static_cast<std::size_t>(i)]));
      zones[l].extend(nodes);
      share(lines[l]) = rounded(zones[l].share());
    }
    if ((share - result.share).cwiseAbs().maxCoeff() < kSettled) {
      result.settled = true;
      break;
    }
    response::SteadyState state = release.solve_shared(share, result.state.displacement);
    if (state.status != Status::converged && !cut_short(state.status)) {
      // Half the way first: the state there is a better guess.
      const response::SteadyState half =
          release.solve_shared(rounded(0.5 * (result.share + share)), result.state.displacement);
      if (half.status == Status::converged) state = release.solve_shared(share, half.displacement);
    }
    result.status = state.status;
    if (state.status != Status::converged) break;
    result.share = share;
    result.state = std::move(state);
  }
  if (!result.settled && result.status == Status::converged) result.status = Status::iteration_limit;
  result.depth = release.shared_depth(result.share, result.state);
  return result;
}

}  // namespace dovetail::wear
