#include "response/summary.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "response/amplitude.hpp"
#include "response/real_block.hpp"

namespace dovetail::response {
namespace {

NodeSummary summarise_node(const SteadyResidual& residual, const ResidualState& state, Eigen::Index i) {
  const reduction::ContactNodes& contact = residual.model().contact();
  const contact::MarchResult& march = state.nodes[static_cast<std::size_t>(i)];
  NodeSummary node;
  bool slips = false;
  for (const contact::SampleState sample : march.state) slips = slips || sample == contact::SampleState::slipping;
  node.slips = slips;
  node.separates = !march.always_closed;
  node.carries_load = !march.always_separated;
  node.stuck = march.always_closed && !slips;
  node.min_normal_force = march.force.col(0).minCoeff();
  node.max_normal_force = march.force.col(0).maxCoeff();
  node.min_pressure = node.min_normal_force / contact.area(i);
  node.max_pressure = node.max_normal_force / contact.area(i);
  node.max_normal_displacement =
      extremes(state.displacement.row(i * residual.model().directions()).transpose()).maximum;
  node.slip_distance = march.slip_distance;
  node.wear_rate = contact.wear_coefficient(i) / contact.area(i) * march.slip_load;
  node.dissipated_energy = contact.friction(i) * march.slip_load;
  node.friction_margin = slips ? 0 : march.friction_margin;
  node.periods = march.periods;
  return node;
}

// e_lambda and e_E: what the truncated series misses of the marched force, and of its power on the slip.
void truncation_errors(const SteadyResidual& residual, const ResidualState& state, SteadyState& steady) {
  const Eigen::Index d = residual.model().directions(), samples = residual.basis().samples();
  const Eigen::MatrixXd force = residual.basis().synthesise(state.force);
  const Eigen::MatrixXd displacement = residual.basis().synthesise(state.displacement);
  double missed = 0, total = 0, power_missed = 0, power = 0;
  for (Eigen::Index i = 0; i < residual.model().nodes(); ++i) {
    const contact::MarchResult& march = state.nodes[static_cast<std::size_t>(i)];
    if (residual.released(i)) continue;
    for (Eigen::Index n = 0; n < samples; ++n) {
      const Eigen::Index before = (n + samples - 1) % samples;
      missed += (march.force.row(n) - force.row(n).segment(i * d, d)).norm();
      total += march.force.row(n).norm();
      double exact = 0, truncated = 0;
      for (Eigen::Index r = 1; r < d; ++r) {
        exact += march.force(n, r) * march.slip_step(n, r - 1) / residual.penalty().tangential(i);
        truncated += force(n, i * d + r) * (displacement(n, i * d + r) - displacement(before, i * d + r));
      }
      power_missed += std::abs(exact - truncated);
      power += std::abs(exact);
    }
  }
  steady.error_force = total > 0 ? missed / total : 0;
  steady.error_energy = power > 0 ? power_missed / power : 0;
}

}  // namespace

void summarise(const SteadyResidual& residual, const ResidualState& state, SteadyState& steady) {
  const CondensedModel& model = residual.model();
  const HarmonicSystem& system = residual.system();
  const Eigen::Index nodes = model.nodes(), d = model.directions();
  steady.omega = system.omega;
  steady.residual = residual.relative_norm(state.residual);
  steady.penalty = residual.penalty();
  steady.displacement = state.displacement;
  steady.force = state.force;
  if (state.status == Status::not_finite) return;
  steady.nodes.clear();
  steady.slip_end.resize(nodes, d - 1);
  steady.wear_rate.resize(nodes);
  steady.friction_energy = 0;
  for (Eigen::Index i = 0; i < nodes; ++i) {
    steady.nodes.push_back(summarise_node(residual, state, i));
    steady.slip_end.row(i) = state.nodes[static_cast<std::size_t>(i)].slip_end.head(d - 1).transpose();
    steady.wear_rate(i) = steady.nodes.back().wear_rate;
    steady.friction_energy += steady.nodes.back().dissipated_energy;
  }
  const Eigen::Index n_out = model.output_gradient(system.harmonics[0]).rows();
  steady.outputs = Eigen::MatrixXd::Zero(n_out, state.displacement.cols());
  steady.input_energy = steady.damping_energy = steady.contact_work = 0;
  for (std::size_t h = 0; h < system.harmonics.size(); ++h) {
    const auto j = static_cast<Eigen::Index>(h);
    const Eigen::VectorXcd contact = harmonic_of(state.displacement, j);
    put_harmonic(model.outputs(system.harmonics[h], contact), j, steady.outputs);
    const CondensedModel::HarmonicEnergy energy =
        model.energy(static_cast<int>(h), system.omega, system.harmonics[h], contact);
    steady.input_energy += energy.input;
    steady.damping_energy += energy.damping;
    steady.contact_work -= std::numbers::pi * static_cast<double>(h) * harmonic_of(state.force, j).dot(contact).imag();
  }
  steady.amplitudes.resize(n_out);
  for (Eigen::Index i = 0; i < n_out; ++i)
    steady.amplitudes(i) = extremes(steady.outputs.row(i).transpose()).amplitude();
  truncation_errors(residual, state, steady);
}

}  // namespace dovetail::response
