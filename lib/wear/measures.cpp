#include "wear/measures.hpp"

#include <algorithm>
#include <limits>

#include "contact/params.hpp"
#include "wear/params.hpp"

namespace dovetail::wear {

double largest(const Eigen::VectorXd& of_nodes) {
  return of_nodes.size() == 0 ? 0.0 : of_nodes.maxCoeff();
}

double worn_volume(const reduction::ContactNodes& contact, const Eigen::VectorXd& depth) {
  return depth.size() == 0 ? 0.0 : contact.area.dot(depth);
}

std::vector<bool> worn_nodes(const Eigen::VectorXd& depth) {
  std::vector<bool> worn(static_cast<std::size_t>(depth.size()));
  for (Eigen::Index i = 0; i < depth.size(); ++i)
    worn[static_cast<std::size_t>(i)] = depth[i] > NoWearParams{}.worn * depth.maxCoeff();
  return worn;
}

bool rests_in_slip(const dynamics::CondensedModel& model) {
  for (Eigen::Index i = 0; i < model.nodes(); ++i)
    if (model.wear_law().resting_energy(model.wear_node(i)) > 0.0) return true;
  return false;
}

double cycle_jump(const Eigen::VectorXd& rate, double increment) {
  const double fastest = largest(rate);
  return fastest > 0.0 ? increment / fastest : std::numeric_limits<double>::infinity();
}

double own_stiffness(const dynamics::CondensedModel& model, Eigen::Index node, Eigen::Index direction) {
  constexpr contact::PenaltyParams kParams;
  const double stiffest = model.local_stiffness().maxCoeff();
  const double own = model.local_stiffness()[node * model.directions() + direction];
  if (own > kParams.no_stiffness * stiffest) return own;
  return stiffest > 0.0 ? kParams.least_stiffness * stiffest : 1.0;
}

double largest_penetration(const dynamics::CondensedModel& model, const steady::State& state) {
  double penetration = 0.0;
  for (Eigen::Index i = 0; i < model.nodes(); ++i)
    penetration =
        std::max(penetration, state.nodes[static_cast<std::size_t>(i)].max_normal_force / own_stiffness(model, i, 0));
  return penetration;
}

}  // namespace dovetail::wear
