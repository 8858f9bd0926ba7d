#include "response/preload.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "response/real_block.hpp"
#include "response/solve.hpp"

namespace dovetail::response {
namespace {

struct Level {
  Status status = Status::iteration_limit;
  int iterations = 0;
  Eigen::MatrixXd displacement;
  ResidualState state;
};

// The contact problem of harmonic 0 at one load level, with the slip of the level before.
Level solve_level(const std::shared_ptr<const CondensedModel>& model, double scale, const ContactCondition& condition,
                  const PreloadOptions& options, const Eigen::MatrixXd& start) {
  const auto system = std::make_shared<const HarmonicSystem>(harmonic_system(*model, 0, 0, scale));
  Level level;
  level.status = system->status;
  if (level.status != Status::converged) return level;
  const contact::PseudoPenalty penalty = contact::pseudo_penalty(model->local_stiffness(), model->directions(),
                                                                 options.normal_penalty, options.tangential_penalty);
  const auto attempt = [&](const std::shared_ptr<const HarmonicSystem>& at, double ratio, const Eigen::MatrixXd& from) {
    level.status = Status::budget_spent;
    if (spent(options.budget)) return false;
    const SteadyResidual residual(model, at, numerics::FourierBasis(0, 1), penalty.scaled(ratio), condition,
                                  {.periodic = false}, options.budget);
    Attempt found = solve(residual, from.size() > 0 ? from : residual.closed_start(), Method::newton, options.tolerance,
                          options.max_iterations);
    level.iterations += found.iterations;
    level.status = found.status;
    level.displacement = std::move(found.displacement);
    if (level.status == Status::converged) residual.evaluate(level.displacement, false, level.state);
    return level.status == Status::converged;
  };
  for (const double ratio : contact::kPenaltyCascade) {
    if (start.size() > 0 && attempt(system, ratio, start)) return level;
    if (attempt(system, ratio, {})) return level;
  }
  // Springs that pull the contact back to where it starts keep a floating body near its slot; taken away in steps, they
  // lead to the state in which the contact alone holds it.
  const SteadyResidual plain(model, system, numerics::FourierBasis(0, 1), penalty, condition, {.periodic = false});
  const Eigen::MatrixXd anchor = start.size() > 0 ? start : plain.closed_start();
  const double scale_of_stiffness = model->local_stiffness().maxCoeff();
  Eigen::MatrixXd from = anchor;
  for (const double share : {1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7}) {
    const double spring = share * scale_of_stiffness;
    auto leaned = std::make_shared<HarmonicSystem>(*system);
    leaned->harmonics.front().stiffness.diagonal().array() += spring;
    leaned->force.col(0) += spring * anchor.col(0);
    if (attempt(leaned, 1, from)) from = level.displacement;
  }
  for (const double ratio : contact::kPenaltyCascade)
    if (attempt(system, ratio, from)) return level;
  return level;
}

}  // namespace

Preload quasi_static(const std::shared_ptr<const CondensedModel>& model, const PreloadOptions& options,
                     const Eigen::VectorXd& wear_depth) {
  if (std::vector<Violation> found = violations(options); !found.empty()) throw InputError(std::move(found));
  const Eigen::Index nodes = model->nodes(), d = model->directions();
  const reduction::ContactNodes& contact = model->contact();
  ContactCondition condition{.wear_depth = wear_depth, .released = {}, .slip_origin = contact.slip_origin};
  Preload preload;
  preload.slip_origin = contact.slip_origin;
  Eigen::MatrixXd displacement;
  ResidualState state;
  // An interference fit presses before any load does. Without one there is nothing to solve at load zero.
  const bool pressed = nodes > 0 && contact.gap.minCoeff() < 0;
  double reached = 0, step = 1.0 / options.steps;
  bool at_zero = pressed;
  while (at_zero || reached < 1) {
    double scale = at_zero ? 0 : reached + step;
    if (scale > 1 - 1e-9) scale = 1;
    Level level = solve_level(model, scale, condition, options, displacement);
    preload.iterations += level.iterations;
    preload.status = within(options.budget, level.status);
    if (preload.status == Status::budget_spent) return preload;
    const bool tried_zero = std::exchange(at_zero, false);
    if (level.status != Status::converged) {
      if (tried_zero) continue;
      // The path is what counts, not its steps: shorter ones follow it more closely.
      step /= 2;
      if (step * options.steps < std::ldexp(1.0, -options.halvings)) return preload;
      continue;
    }
    reached = scale;
    step = std::min(2 * step, 1.0 / options.steps);
    displacement = level.displacement;
    state = std::move(level.state);
    for (Eigen::Index i = 0; i < nodes; ++i)
      condition.slip_origin.row(i) = state.nodes[static_cast<std::size_t>(i)].slip_end.head(d - 1).transpose();
  }
  preload.displacement = displacement;
  preload.force = state.force;
  preload.slip_origin = condition.slip_origin;
  preload.pressure.resize(nodes);
  preload.friction_use = Eigen::VectorXd::Zero(nodes);
  for (Eigen::Index i = 0; i < nodes; ++i) {
    const double normal = preload.force(i * d), limit = contact.friction(i) * normal;
    preload.pressure(i) = normal / contact.area(i);
    if (limit > 0) preload.friction_use(i) = preload.force.segment(i * d + 1, d - 1).norm() / limit;
  }
  const HarmonicStiffness at = model->harmonic(0, 0);
  preload.full_displacement = model->recover(at, preload.displacement.cast<std::complex<double>>()).real();
  return preload;
}

}  // namespace dovetail::response
