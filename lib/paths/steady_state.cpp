#include "paths/steady_state.hpp"

#include <algorithm>
#include <string>

#include "paths/ways.hpp"

namespace dovetail::paths {
namespace {

/// That of a tangent lent, where it is of the same frequency and model.
std::shared_ptr<const dynamics::HarmonicSystem> system_of(const steady::Joint& joint, double omega,
                                                          const steady::Tangent* lent) {
  if (lent != nullptr) {
    const steady::Problem& of = lent->problem();
    if (&of.model() == joint.model.get() && of.system().omega == omega && of.system().of_model &&
        of.options().harmonics == joint.options.harmonics)
      return of.shared_system();
  }
  return std::make_shared<const dynamics::HarmonicSystem>(
      dynamics::harmonic_system(*joint.model, joint.options.harmonics, omega));
}

}  // namespace

steady::State steady_state(const steady::Joint& joint, double omega, const Eigen::MatrixXd& guess,
                           const std::shared_ptr<const steady::Tangent>& reuse, const WayParams& ways) {
  steady::validate(joint.options);
  if (!kPositive.contains(omega))
    throw InputError({.file = {}, .key = "omega", .value = shortest(omega), .allowed = kPositive.phrase()});
  const Eigen::Index rows = joint.model->contact_size(), columns = 2 * joint.options.harmonics + 1;
  if (guess.size() > 0 && (guess.rows() != rows || guess.cols() != columns))
    throw InputError({.file = {},
                      .key = "guess",
                      .value = std::to_string(guess.rows()) + " x " + std::to_string(guess.cols()),
                      .allowed = "must be " + std::to_string(rows) + " x " + std::to_string(columns)});
  steady::State without;
  without.omega = omega;
  without.status = Status::budget_spent;
  if (spent(joint.options.budget)) return without;
  std::shared_ptr<const dynamics::HarmonicSystem> system = system_of(joint, omega, reuse.get());
  if (system->status != Status::converged) {
    without.status = system->status;
    return without;
  }
  steady::Attempt found =
      try_ways(joint, std::make_shared<const steady::Problem>(joint, std::move(system)), guess, reuse, ways);
  // What was not found from the guess is next to nothing that was shown to be regular.
  const bool show = joint.options.show_regular || found.way != steady::Way::guess;
  const steady::AtSolution jacobian = joint.options.linearise ? steady::AtSolution::linearise
                                      : show                  ? steady::AtSolution::show_regular
                                                              : steady::AtSolution::trust;
  steady::State state = steady::described(std::move(found.point), found.status, jacobian, found.tangent.get());
  state.status = within(joint.options.budget, state.status);
  static_cast<steady::Work&>(state) = found;
  return state;
}

Eigen::MatrixXd padded(const Eigen::MatrixXd& coefficients, int harmonics) {
  const Eigen::Index columns = 2 * harmonics + 1, kept = std::min(columns, coefficients.cols());
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(coefficients.rows(), columns);
  result.leftCols(kept) = coefficients.leftCols(kept);
  return result;
}

steady::State refined_state(steady::Joint finer, const steady::State& state,
                            const std::shared_ptr<const steady::Tangent>& reuse) {
  finer.options.penalty_scale *= state.penalty_ratio;
  finer.options = finer.options.plain();
  finer.options.show_regular = false;
  steady::State refined = steady_state(finer, state.omega, padded(state.displacement, finer.options.harmonics), reuse);
  refined.penalty_ratio *= state.penalty_ratio;
  return refined;
}

}  // namespace dovetail::paths
