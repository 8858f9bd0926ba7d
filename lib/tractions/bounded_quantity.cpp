#include "tractions/bounded_quantity.hpp"

#include <algorithm>
#include <cmath>

#include "paths/steady_state.hpp"
#include "tractions/slip_origin_sensitivity.hpp"

namespace dovetail::tractions {

FamilyQuantity::FamilyQuantity(steady::Joint joint, BoundedQuantity quantity, Eigen::Index output, double omega,
                               double search_range)
    : joint_(std::move(joint)), quantity_(quantity), output_(output), omega_(omega), search_range_(search_range) {
  joint_.options.linearise = true;
}

steady::State FamilyQuantity::solve(const Eigen::MatrixXd& origin, const Eigen::MatrixXd& guess) {
  ++solves_;
  steady::Joint member = joint_;
  if (origin.size() > 0) member.condition.slip_origin = origin;
  if (quantity_ != BoundedQuantity::resonance_amplitude && quantity_ != BoundedQuantity::resonance_frequency)
    return paths::steady_state(member, omega_, guess);
  // Members are tracked from the nominal resonance: another peak is no answer.
  const paths::ResonanceOptions near{
      .output = static_cast<int>(output_), .search_range = search_range_, .sweep_range = 0};
  paths::Resonance found = paths::resonance(member, omega_, near, guess);
  found.state.status = found.status;
  return std::move(found.state);
}

// Of slip loads in the quantity.
Eigen::VectorXd FamilyQuantity::weights(const steady::State& member) const {
  const dynamics::CondensedModel& model = *joint_.model;
  if (quantity_ != BoundedQuantity::wear_rate) return model.contact().friction;
  Eigen::VectorXd weights(model.nodes());
  for (Eigen::Index i = 0; i < weights.size(); ++i)
    weights(i) =
        model.contact().area(i) * model.wear_rate(i, member.nodes[static_cast<std::size_t>(i)].slip_load).by_slip_load;
  return weights;
}

double FamilyQuantity::scale(const steady::State& member) const {
  // Slip that is rounding next to the energy the excitation puts in is none.
  const double energy = std::abs(member.input_energy);
  if (quantity_ == BoundedQuantity::friction_energy) return energy;
  if (quantity_ != BoundedQuantity::wear_rate) return 0;
  double ratio = 0;
  for (Eigen::Index i = 0; i < joint_.model->nodes(); ++i)
    ratio = std::max(ratio, joint_.model->wear_law().volume_per_energy(joint_.model->wear_node(i)));
  return ratio * energy;
}

double FamilyQuantity::value(const steady::State& member) const {
  switch (quantity_) {
    case BoundedQuantity::friction_energy:
      return member.friction_energy;
    case BoundedQuantity::wear_rate:
      return joint_.model->contact().area.dot(member.wear_rate);
    case BoundedQuantity::resonance_frequency:
      return member.omega;
    case BoundedQuantity::amplitude:
    case BoundedQuantity::resonance_amplitude:
      break;
  }
  return member.amplitudes(output_);
}

// dq/dX_T. The amplitude at a resonance is stationary in frequency, so its gradient is that at constant frequency.
Eigen::MatrixXd FamilyQuantity::gradient(const steady::State& member) {
  switch (quantity_) {
    case BoundedQuantity::friction_energy:
    case BoundedQuantity::wear_rate:
      return slip_load_to_slip_origin(member, weights(member));
    case BoundedQuantity::resonance_frequency:
      return frequency_gradient(member);
    case BoundedQuantity::amplitude:
    case BoundedQuantity::resonance_amplitude:
      break;
  }
  return amplitude_to_slip_origin(member, output_);
}

// dw/dX = -(d2A/dw dX) / (d2A/dw2), both by central differences of exact first derivatives.
Eigen::MatrixXd FamilyQuantity::frequency_gradient(const steady::State& member) {
  Eigen::MatrixXd mixed = Eigen::MatrixXd::Zero(joint_.model->nodes(), joint_.model->directions() - 1);
  double curvature = 0;
  constexpr double kStep = 1e-5;
  for (const double side : {-1.0, 1.0}) {
    steady::Joint beside = joint_;
    beside.condition.slip_origin = member.tangent->problem().condition().slip_origin;
    const steady::State near = paths::steady_state(beside, member.omega * (1 + side * kStep), member.displacement);
    ++solves_;
    if (near.status != Status::converged) return Eigen::MatrixXd::Zero(mixed.rows(), mixed.cols());
    mixed += side * amplitude_to_slip_origin(near, output_);
    curvature += side * paths::amplitude_slope(near, output_).slope;
  }
  return curvature < 0 ? Eigen::MatrixXd(mixed / -curvature) : Eigen::MatrixXd::Zero(mixed.rows(), mixed.cols());
}

std::string_view to_string(BoundedQuantity quantity) {
  switch (quantity) {
    case BoundedQuantity::amplitude:
      return "amplitude";
    case BoundedQuantity::friction_energy:
      return "friction_energy";
    case BoundedQuantity::wear_rate:
      return "wear_rate";
    case BoundedQuantity::resonance_amplitude:
      return "resonance_amplitude";
    case BoundedQuantity::resonance_frequency:
      return "resonance_frequency";
  }
  return "unknown";
}

}  // namespace dovetail::tractions
