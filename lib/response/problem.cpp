#include "response/problem.hpp"

#include <Eigen/Cholesky>
#include <algorithm>

#include "response/summary.hpp"

namespace dovetail::response {
namespace {

// Forces of the contact may be far larger than the excitation that the residual is measured by.
contact::MarchOptions march_options(const SteadyOptions& options, double force_scale) {
  constexpr double kShare = 0.1;
  return {.slip_return = options.slip_return == "second_order" ? contact::SlipReturn::second_order
                                                               : contact::SlipReturn::first_order,
          .periodic = true,
          .max_periods = options.max_periods,
          .tolerance = options.periodic_tolerance,
          .resolution = kShare * options.tolerance * force_scale};
}

}  // namespace

SteadyResidual steady_problem(const std::shared_ptr<const CondensedModel>& model,
                              std::shared_ptr<const HarmonicSystem> system, const numerics::FourierBasis& basis,
                              const ContactCondition& condition, const SteadyOptions& options, double penalty_ratio) {
  const contact::PseudoPenalty penalty = contact::pseudo_penalty(model->local_stiffness(), model->directions(),
                                                                 options.normal_penalty, options.tangential_penalty);
  const contact::MarchOptions march = march_options(options, system->force_scale);
  return {model, std::move(system), basis, penalty.scaled(penalty_ratio * options.penalty_scale), condition,
          march, options.budget};
}

SteadyState described(const SteadyResidual& residual, const Eigen::MatrixXd& displacement, Status status,
                      AtSolution jacobian, const Linearisation* previous) {
  ResidualState state;
  residual.evaluate(displacement, status == Status::converged, state);
  SteadyState steady;
  summarise(residual, state, steady);
  steady.status = status;
  if (steady.status == Status::converged && state.status != Status::converged) steady.status = state.status;
  // Displacements so large that the balance of the forces drowns in rounding: nothing holds the body there.
  if (steady.status == Status::converged && rounding_floor(residual, state) > kLargestFloor)
    steady.status = Status::singular;
  if (steady.status != Status::converged) return steady;
  if (jacobian == AtSolution::trust) return steady;
  // A body that nothing holds drifts until the residual is small against rounding: that is no state of it.
  constexpr double kFloats = 1e-13;
  auto linear = std::make_shared<const Linearisation>(residual, std::move(state), previous);
  if (linear->status() != Status::converged || linear->regularised() || linear->nearly_singular(kFloats))
    steady.status = Status::singular;
  else if (jacobian == AtSolution::linearise)
    steady.linearisation = std::move(linear);
  return steady;
}

double rounding_floor(const SteadyResidual& residual, const ResidualState& state) {
  const double forces = residual.system().force.norm() + state.prediction.norm();
  return 4e-15 * forces / residual.system().force_scale;
}

bool is_held(const SteadyResidual& residual, const ResidualState& state) {
  Eigen::MatrixXd stiffness = residual.system().harmonics.front().stiffness.real();
  if (stiffness.size() == 0) return true;
  // Rounding may turn a direction without stiffness into a slightly negative one.
  constexpr double kRounding = 1e-11;
  const double shift = kRounding * stiffness.diagonal().cwiseAbs().maxCoeff();
  const Eigen::Index d = residual.model().directions();
  for (Eigen::Index i = 0; i < residual.model().nodes(); ++i) {
    const bool carries = !residual.released(i) && !state.nodes[static_cast<std::size_t>(i)].always_separated;
    for (Eigen::Index r = i * d; r < (i + 1) * d; ++r) stiffness(r, r) += carries ? residual.penalty_of(r) : shift;
  }
  return Eigen::LLT<Eigen::MatrixXd>(stiffness).info() == Eigen::Success;
}

}  // namespace dovetail::response
