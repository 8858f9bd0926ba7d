#include "tractions/bounded_quantity.hpp"

#include <algorithm>
#include <cmath>

#include "paths/amplitude.hpp"
#include "paths/steady_state.hpp"

namespace dovetail::tractions {

FamilyQuantity::FamilyQuantity(steady::Joint joint, BoundedQuantity quantity, Eigen::Index output, double omega)
    : joint_(std::move(joint)), quantity_(quantity), output_(output), omega_(omega) {
  joint_.options.linearise = true;
}

steady::State FamilyQuantity::solve(const Eigen::MatrixXd& origin, const Eigen::MatrixXd& guess) {
  ++solves_;
  steady::Joint member = joint_;
  if (origin.size() > 0) member.condition.slip_origin = origin;
  return paths::steady_state(member, omega_, guess);
}

// Of slip loads and energies in the quantity.
SlipWeights FamilyQuantity::weights(const steady::State& member) const {
  const dynamics::CondensedModel& model = *joint_.model;
  SlipWeights weights{.load = Eigen::VectorXd::Zero(model.nodes()), .energy = Eigen::VectorXd::Ones(model.nodes())};
  if (quantity_ != BoundedQuantity::wear_rate) return weights;
  for (Eigen::Index i = 0; i < model.nodes(); ++i) {
    const steady::NodeSummary& node = member.nodes[static_cast<std::size_t>(i)];
    const contact::WearRate rate = model.wear_rate(i, {.load = node.slip_load, .energy = node.dissipated_energy});
    weights.load(i) = model.contact().area(i) * rate.by_load;
    weights.energy(i) = model.contact().area(i) * rate.by_energy;
  }
  return weights;
}

double FamilyQuantity::scale(const steady::State& member) const {
  // Slip that is rounding next to the energy the excitation puts in is none.
  const double energy = std::abs(member.input_energy);
  if (quantity_ == BoundedQuantity::friction_energy) return energy;
  if (quantity_ != BoundedQuantity::wear_rate) return 0;
  double ratio = 0;
  for (Eigen::Index i = 0; i < joint_.model->nodes(); ++i)
    ratio = std::max(ratio, joint_.model->wear_law().volume_per_energy(joint_.model->wear_node(i), energy));
  return ratio * energy;
}

double FamilyQuantity::value(const steady::State& member) const {
  if (quantity_ == BoundedQuantity::friction_energy) return member.friction_energy;
  if (quantity_ == BoundedQuantity::wear_rate) return joint_.model->contact().area.dot(member.wear_rate);
  return member.amplitudes(output_);
}

// dq/dX_T.
Eigen::MatrixXd FamilyQuantity::gradient(const steady::State& member) const {
  if (quantity_ == BoundedQuantity::amplitude) return amplitude_to_slip_origin(member, output_);
  return slip_to_slip_origin(member, weights(member));
}

}  // namespace dovetail::tractions
