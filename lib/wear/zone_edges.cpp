#include "wear/zone_edges.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace dovetail::wear {

using Eigen::Index;

Eigen::VectorXd friction_reserve(const response::CondensedModel& model, const response::SteadyState& state,
                                 const std::vector<bool>& slips) {
  Eigen::VectorXd reserve(model.nodes());
  for (Index i = 0; i < reserve.size(); ++i) {
    const auto node = static_cast<std::size_t>(i);
    if (!state.nodes[node].carries_load)
      reserve[i] = std::numeric_limits<double>::quiet_NaN();
    else
      reserve[i] = slips[node] ? -slip_excess(model, state, i)
                               : std::max(0.0, friction_margin(state, i, model.contact().friction[i]));
  }
  return reserve;
}

namespace {

// Next to an edge the margin grows like the square root of the distance and slip like its power 3/2, so that means over
// cells of equal length are not equally far from zero. Measured on dovetails with 24 to 96 edges per flank and cells of
// unequal lengths: with this weight, times the ratio of the lengths, an edge stays where it is (within 1 % of the worn
// volume) whatever the cells.
constexpr double kExcess = 0.7;

}  // namespace

std::vector<ZoneEdge> zone_edges(const ReleaseTrail& trail, std::span<const std::vector<int>> lines, const Eigen::VectorXd& size) {
  std::vector<ZoneEdge> edges;
  for (std::size_t l = 0; l < lines.size(); ++l)
    for (std::size_t k = 0; k + 1 < lines[l].size(); ++k) {
      int worn = lines[l][k], bearing = lines[l][k + 1];
      const auto pass_of = [&](int node) { return trail.released_in[static_cast<std::size_t>(node)]; };
      if ((pass_of(worn) < 0) == (pass_of(bearing) < 0)) continue;
      if (pass_of(worn) < 0) std::swap(worn, bearing);
      const Eigen::VectorXd& reserve = trail.reserves[static_cast<std::size_t>(pass_of(worn))];
      const double excess = -kExcess * size[worn] / size[bearing] * reserve[worn], margin = reserve[bearing];
      if (std::isnan(margin) || !(excess + margin > 0) || std::isinf(margin)) continue;
      edges.push_back({.line = static_cast<int>(l), .worn = worn, .bearing = bearing, .fraction = excess / (excess + margin)});
    }
  return edges;
}

}  // namespace dovetail::wear
