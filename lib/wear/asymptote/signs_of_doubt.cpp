#include "wear/asymptote/signs_of_doubt.hpp"

#include <algorithm>

#include "wear/params.hpp"
#include "wear/release/friction_reserve.hpp"

namespace dovetail::wear {

using Eigen::Index;
using Eigen::VectorXd;

bool same_depth(const VectorXd& a, const VectorXd& b, double tolerance) {
  if (a.size() == 0) return true;
  return (a - b).cwiseAbs().maxCoeff() <= tolerance * std::max(a.maxCoeff(), b.maxCoeff());
}

bool reloads(const VectorXd& deepest, const VectorXd& depth, double tolerance) {
  return deepest.size() > 0 && (deepest - depth).maxCoeff() > tolerance * depth.maxCoeff();
}

bool lifts_off(const Passes& passes, const VectorXd& depth, double tolerance) {
  const double least = tolerance * depth.maxCoeff();
  for (std::size_t i = 0; i < passes.touching.size(); ++i)
    if (passes.touching[i] && depth[static_cast<Index>(i)] > least) return true;
  return false;
}

bool near_slip(const dynamics::CondensedModel& model, const steady::State& state, const std::vector<bool>& released) {
  for (std::size_t i = 0; i < released.size(); ++i) {
    const auto node = static_cast<Index>(i);
    if (!released[i] && state.nodes[i].carries_load &&
        friction_margin(state, node, model.contact_law(node)) < DoubtParams{}.near_slip)
      return true;
  }
  return false;
}

bool slips_on_the_way(WearingJoint& joint, const steady::State& unworn, const VectorXd& depth,
                      const std::vector<bool>& released) {
  constexpr DoubtParams kParams;
  const VectorXd& start = joint.start();
  steady::State state = unworn;
  for (const double share : {kParams.early, kParams.late}) {
    state = joint.worn(start + share * (depth - start), state.displacement);
    if (state.status != Status::converged) return true;
    for (std::size_t i = 0; i < released.size(); ++i)
      if (!released[i] && state.nodes[i].wear_rate > kParams.slips * state.wear_rate.maxCoeff()) return true;
  }
  return false;
}

}  // namespace dovetail::wear
