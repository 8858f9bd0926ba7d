#include "response/bounded_quantity.hpp"

#include <algorithm>
#include <cmath>

#include "response/slip_origin_sensitivity.hpp"

namespace dovetail::response {

FamilyQuantity::FamilyQuantity(std::shared_ptr<const CondensedModel> model, BoundedQuantity quantity,
                               Eigen::Index output, double omega, double search_range, ContactCondition condition,
                               SteadyOptions options)
    : model_(std::move(model)),
      quantity_(quantity),
      output_(output),
      omega_(omega),
      search_range_(search_range),
      condition_(std::move(condition)),
      options_(std::move(options)) {
  options_.linearise = true;
}

SteadyState FamilyQuantity::solve(const Eigen::MatrixXd& origin, const Eigen::MatrixXd& guess) {
  ++solves_;
  ContactCondition condition = condition_;
  if (origin.size() > 0) condition.slip_origin = origin;
  if (quantity_ != BoundedQuantity::resonance_amplitude && quantity_ != BoundedQuantity::resonance_frequency)
    return steady_state(model_, omega_, condition, options_, guess);
  // Members are tracked from the nominal resonance: another peak is no answer.
  const ResonanceOptions near{.output = static_cast<int>(output_), .search_range = search_range_, .sweep_range = 0};
  Resonance found = resonance(model_, omega_, condition, options_, near, guess);
  found.state.status = found.status;
  return std::move(found.state);
}

Eigen::VectorXd FamilyQuantity::weights() const {
  const reduction::ContactNodes& contact = model_->contact();
  // Volume is area times depth, so areas cancel.
  return quantity_ == BoundedQuantity::wear_rate ? contact.wear_coefficient : contact.friction;
}

double FamilyQuantity::scale(const SteadyState& member) const {
  // Slip that is rounding next to the energy the excitation puts in is none.
  const double energy = std::abs(member.input_energy);
  if (quantity_ == BoundedQuantity::friction_energy) return energy;
  if (quantity_ != BoundedQuantity::wear_rate) return 0;
  double ratio = 0;
  for (Eigen::Index i = 0; i < model_->nodes(); ++i)
    if (model_->contact().friction(i) > 0)
      ratio = std::max(ratio, model_->contact().wear_coefficient(i) / model_->contact().friction(i));
  return ratio * energy;
}

double FamilyQuantity::value(const SteadyState& member) const {
  switch (quantity_) {
    case BoundedQuantity::friction_energy:
      return member.friction_energy;
    case BoundedQuantity::wear_rate:
      return model_->contact().area.dot(member.wear_rate);
    case BoundedQuantity::resonance_frequency:
      return member.omega;
    case BoundedQuantity::amplitude:
    case BoundedQuantity::resonance_amplitude:
      break;
  }
  return member.amplitudes(output_);
}

// dq/dX_T. The amplitude at a resonance is stationary in frequency, so its gradient is that at constant frequency.
Eigen::MatrixXd FamilyQuantity::gradient(const SteadyState& member) {
  switch (quantity_) {
    case BoundedQuantity::friction_energy:
    case BoundedQuantity::wear_rate:
      return slip_load_to_slip_origin(member, weights());
    case BoundedQuantity::resonance_frequency:
      return frequency_gradient(member);
    case BoundedQuantity::amplitude:
    case BoundedQuantity::resonance_amplitude:
      break;
  }
  return amplitude_to_slip_origin(member, output_);
}

// dw/dX = -(d2A/dw dX) / (d2A/dw2), both by central differences of exact first derivatives.
Eigen::MatrixXd FamilyQuantity::frequency_gradient(const SteadyState& member) {
  Eigen::MatrixXd mixed = Eigen::MatrixXd::Zero(model_->nodes(), model_->directions() - 1);
  double curvature = 0;
  constexpr double kStep = 1e-5;
  for (const double side : {-1.0, 1.0}) {
    ContactCondition condition = condition_;
    condition.slip_origin = member.linearisation->residual().condition().slip_origin;
    const SteadyState near =
        steady_state(model_, member.omega * (1 + side * kStep), condition, options_, member.displacement);
    ++solves_;
    if (near.status != Status::converged) return Eigen::MatrixXd::Zero(mixed.rows(), mixed.cols());
    mixed += side * amplitude_to_slip_origin(near, output_);
    curvature += side * amplitude_slope(near, output_).slope;
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

}  // namespace dovetail::response
