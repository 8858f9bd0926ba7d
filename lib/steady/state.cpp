#include "steady/state.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "dynamics/extremes.hpp"
#include "dynamics/real_block.hpp"
#include "steady/params.hpp"

namespace dovetail::steady {
namespace {

NodeSummary summarise_node(const Point& point, Eigen::Index i) {
  const reduction::ContactNodes& contact = point.problem->model().contact();
  const contact::MarchResult& march = point.nodes[static_cast<std::size_t>(i)];
  NodeSummary node;
  const bool slips = std::ranges::find(march.state, contact::SampleState::slipping) != march.state.end();
  node.slips = slips;
  node.separates = !march.always_closed;
  node.carries_load = !march.always_separated;
  node.stuck = march.always_closed && !slips;
  node.min_normal_force = march.force.col(0).minCoeff();
  node.max_normal_force = march.force.col(0).maxCoeff();
  node.min_pressure = node.min_normal_force / contact.area(i);
  node.max_pressure = node.max_normal_force / contact.area(i);
  node.slip_distance = march.slip_distance;
  node.slip_load = march.slip_load;
  node.wear_rate = point.problem->model().wear_rate(i, {.load = march.slip_load, .energy = march.dissipation}).depth;
  node.dissipated_energy = march.dissipation;
  node.periods = march.periods;
  return node;
}

// e_lambda and e_E: what the truncated series misses of the marched force, and of its power on the slip.
void truncation_errors(const Point& point, Summary& summary) {
  const Problem& of = *point.problem;
  const Eigen::Index d = of.model().directions(), samples = of.basis().samples();
  const Eigen::MatrixXd force = of.basis().synthesise(point.force);
  const Eigen::MatrixXd displacement = of.basis().synthesise(point.displacement);
  double missed = 0, total = 0, power_missed = 0, power = 0;
  for (Eigen::Index i = 0; i < of.model().nodes(); ++i) {
    const contact::MarchResult& march = point.nodes[static_cast<std::size_t>(i)];
    if (of.released(i)) continue;
    for (Eigen::Index n = 0; n < samples; ++n) {
      const Eigen::Index before = (n + samples - 1) % samples;
      missed += (march.force.row(n) - force.row(n).segment(i * d, d)).norm();
      total += march.force.row(n).norm();
      double exact = 0, truncated = 0;
      for (Eigen::Index r = 1; r < d; ++r) {
        exact += march.force(n, r) * march.slip_step(n, r - 1) / of.penalty().tangential(i);
        truncated += force(n, i * d + r) * (displacement(n, i * d + r) - displacement(before, i * d + r));
      }
      power_missed += std::abs(exact - truncated);
      power += std::abs(exact);
    }
  }
  summary.error_force = total > 0 ? missed / total : 0;
  summary.error_energy = power > 0 ? power_missed / power : 0;
}

}  // namespace

Summary summarise(const Point& point) {
  const Problem& of = *point.problem;
  const dynamics::CondensedModel& model = of.model();
  const Eigen::Index nodes = model.nodes(), d = model.directions();
  Summary summary;
  summary.omega = of.system().omega;
  summary.residual = point.error();
  summary.penalty_ratio = of.penalty_ratio();
  summary.penalty = of.penalty();
  summary.displacement = point.displacement;
  summary.force = point.force;
  if (point.status == Status::not_finite) return summary;
  summary.slip_end.resize(nodes, d - 1);
  summary.wear_rate.resize(nodes);
  for (Eigen::Index i = 0; i < nodes; ++i) {
    summary.nodes.push_back(summarise_node(point, i));
    summary.slip_end.row(i) = point.nodes[static_cast<std::size_t>(i)].slip_end.head(d - 1).transpose();
    summary.wear_rate(i) = summary.nodes.back().wear_rate;
    summary.friction_energy += summary.nodes.back().dissipated_energy;
  }
  const Eigen::Index n_out = model.output_count();
  summary.outputs = Eigen::MatrixXd::Zero(n_out, point.displacement.cols());
  for (std::size_t h = 0; h < of.system().harmonics.size(); ++h) {
    const auto j = static_cast<Eigen::Index>(h);
    const dynamics::CondensedHarmonic& at = of.system().harmonics[h];
    const Eigen::VectorXcd contact = dynamics::harmonic_of(point.displacement, j);
    dynamics::put_harmonic(model.outputs(at, contact), j, summary.outputs);
    const dynamics::CondensedModel::HarmonicEnergy energy =
        model.energy(static_cast<int>(h), of.system().omega, at, contact);
    summary.input_energy += energy.input;
    summary.damping_energy += energy.damping;
    summary.contact_work -=
        std::numbers::pi * static_cast<double>(h) * dynamics::harmonic_of(point.force, j).dot(contact).imag();
  }
  summary.amplitudes.resize(n_out);
  for (Eigen::Index i = 0; i < n_out; ++i)
    summary.amplitudes(i) = dynamics::extremes(summary.outputs.row(i).transpose()).amplitude();
  truncation_errors(point, summary);
  return summary;
}

State described(Point point, Status status, AtSolution jacobian, const Tangent* previous) {
  State state;
  static_cast<Summary&>(state) = summarise(point);
  state.status = status;
  if (status != Status::converged) return state;
  // Displacements so large that the balance of the forces drowns in rounding: nothing holds the body there.
  if (point.status != Status::converged)
    state.status = point.status;
  else if (rounding_floor(point) > FloorParams{}.largest)
    state.status = Status::singular;
  if (state.status != Status::converged || jacobian == AtSolution::trust) return state;
  // A body that nothing holds can be moved until its residual is small against rounding. Its Jacobian is singular.
  differentiate(point);
  auto tangent = std::make_shared<const Tangent>(std::make_shared<const Point>(std::move(point)), previous,
                                                 Factorise::when_needed);
  if (!tangent->is_regular())
    state.status = Status::singular;
  else if (jacobian == AtSolution::linearise)
    state.tangent = std::move(tangent);
  return state;
}

}  // namespace dovetail::steady
