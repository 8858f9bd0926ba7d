#include "wear/release/friction_reserve.hpp"

#include <algorithm>
#include <limits>

#include "wear/params.hpp"

namespace dovetail::wear {

using Eigen::Index;
using Eigen::MatrixXd;

namespace {

/// Overload relieved by the slip of a node, in units of mu lambda_N: k_T (slip distance) / (4 mu max lambda_N) with the
/// node's own stiffness k_T (two reversals per cycle, each sliding by twice the overload over k_T).
double slip_excess(const dynamics::CondensedModel& model, const steady::State& state, Index node) {
  const steady::NodeSummary& summary = state.nodes[static_cast<std::size_t>(node)];
  const double limit = model.contact_law(node).limit(summary.max_normal_force).force;
  return limit > 0.0 ? summary.slip_distance * model.local_stiffness()[node * model.directions() + 1] / (4.0 * limit)
                     : 0.0;
}

}  // namespace

double friction_margin(const steady::State& state, Index node, const contact::NodeLaw& law) {
  // Samples close to separation carry next to nothing: their ratio of forces is noise.
  constexpr double kLightLoad = DoubtParams{}.light_load;
  const double largest = state.nodes[static_cast<std::size_t>(node)].max_normal_force;
  double margin = std::numeric_limits<double>::infinity();
  if (!(largest > 0.0) || !law.rubs() || !state.tangent) return margin;
  const MatrixXd& force = state.tangent->point().nodes[static_cast<std::size_t>(node)].force;
  const Index tangential = force.cols() - 1;
  for (Index n = 0; n < force.rows(); ++n) {
    if (force(n, 0) <= kLightLoad * largest) continue;
    for (Index m = 0; m <= n; ++m)
      if (force(m, 0) > kLightLoad * largest)
        margin = std::min(margin, 1.0 - (force.row(n) - force.row(m)).tail(tangential).norm() /
                                            (law.limit(force(n, 0)).force + law.limit(force(m, 0)).force));
  }
  return margin;
}

Eigen::VectorXd friction_reserve(const dynamics::CondensedModel& model, const steady::State& state,
                                 const std::vector<bool>& slips) {
  Eigen::VectorXd reserve(model.nodes());
  for (Index i = 0; i < reserve.size(); ++i) {
    const auto node = static_cast<std::size_t>(i);
    if (!state.nodes[node].carries_load)
      reserve[i] = std::numeric_limits<double>::quiet_NaN();
    else
      reserve[i] =
          slips[node] ? -slip_excess(model, state, i) : std::max(0.0, friction_margin(state, i, model.contact_law(i)));
  }
  return reserve;
}

}  // namespace dovetail::wear
