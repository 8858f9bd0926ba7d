#include "steady/preload.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "contact/params.hpp"
#include "steady/params.hpp"
#include "steady/solve.hpp"

namespace dovetail::steady {
namespace {

constexpr contact::PenaltyParams kPenalty;
constexpr PreloadParams kPreload;

// The contact problem of harmonic 0 at one load level, with the slip of the level before, whose factors serve as long
// as few nodes change what they do. `foreseen`: where it is searched first, or empty.
Attempt solve_level(const Joint& joint, double scale, const Eigen::MatrixXd& foreseen, const Attempt& before) {
  const Eigen::MatrixXd& start = before.point.displacement;
  const auto system =
      std::make_shared<const dynamics::HarmonicSystem>(dynamics::harmonic_system(*joint.model, 0, 0, scale));
  Attempt level;
  level.status = system->status;
  if (level.status != Status::converged) return level;
  const Problem problem(joint, system);
  const auto attempt = [&](const Problem& at, const Eigen::MatrixXd& from) {
    const int so_far = level.iterations;
    if (spent(joint.options.budget)) {
      level.status = Status::budget_spent;
      return false;
    }
    level = solve(std::make_shared<const Problem>(at), from.size() > 0 ? from : at.closed_start(), Method::newton,
                  joint.options.max_iterations, before.tangent);
    level.iterations += so_far;
    return level.status == Status::converged;
  };
  for (const double ratio : kPenalty.cascade) {
    for (const Eigen::MatrixXd* from : {&foreseen, &start})
      if (from->size() > 0 && attempt(problem.with_penalty(ratio), *from)) return level;
    if (attempt(problem.with_penalty(ratio), {})) return level;
  }
  const Eigen::MatrixXd anchor = start.size() > 0 ? start : problem.closed_start();
  Eigen::MatrixXd from = anchor;
  for (const double share : kPreload.springs) {
    const double spring = share * joint.model->local_stiffness().maxCoeff();
    auto leaned = std::make_shared<dynamics::HarmonicSystem>(*system);
    leaned->of_model = false;
    leaned->stiffness.add_to_diagonal(0, Eigen::VectorXcd::Constant(leaned->stiffness.size(), spring));
    leaned->force.col(0) += spring * anchor.col(0);
    if (attempt(problem.at(leaned), from)) from = level.point.displacement;
  }
  for (const double ratio : kPenalty.cascade)
    if (attempt(problem.with_penalty(ratio), from)) return level;
  return level;
}

}  // namespace

Preload quasi_static(const std::shared_ptr<const dynamics::CondensedModel>& model, const PreloadOptions& options,
                     const Eigen::VectorXd& wear_depth) {
  if (std::vector<Violation> found = violations(options); !found.empty()) throw InputError(std::move(found));
  const Eigen::Index nodes = model->nodes(), d = model->directions();
  const reduction::ContactNodes& contact = model->contact();
  Joint joint{.model = model,
              .condition = {.wear_depth = wear_depth, .released = {}, .slip_origin = contact.slip_origin},
              .options = {.harmonics = 0,
                          .samples = 1,
                          .tolerance = options.tolerance,
                          .max_iterations = options.max_iterations,
                          .normal_penalty = options.normal_penalty,
                          .tangential_penalty = options.tangential_penalty,
                          .budget = options.budget}};
  Preload preload;
  preload.slip_origin = contact.slip_origin;
  Attempt last;
  const Point& point = last.point;
  // An interference fit presses before any load does. Without one there is nothing to solve at load zero.
  const bool pressed = nodes > 0 && contact.gap.minCoeff() < 0;
  double reached = 0, step = 1.0 / options.steps;
  Eigen::MatrixXd rate;  // of the displacement with the load, over the last step
  bool at_zero = pressed;
  while (at_zero || reached < 1) {
    double scale = at_zero ? 0 : reached + step;
    if (scale > 1 - kPreload.whole) scale = 1;
    // As long as no node changes what it does displacements are linear in the load.
    const Eigen::MatrixXd foreseen =
        rate.size() > 0 ? Eigen::MatrixXd(point.displacement + (scale - reached) * rate) : rate;
    Attempt level = solve_level(joint, scale, foreseen, last);
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
    if (scale > reached) {
      const Eigen::MatrixXd unloaded = Eigen::MatrixXd::Zero(nodes * d, 1);
      const Eigen::MatrixXd& before = point.displacement.size() > 0 ? point.displacement : unloaded;
      rate = (level.point.displacement - before) / (scale - reached);
    }
    reached = scale;
    step = std::min(2 * step, 1.0 / options.steps);
    last = std::move(level);
    for (Eigen::Index i = 0; i < nodes; ++i)
      joint.condition.slip_origin.row(i) = point.nodes[static_cast<std::size_t>(i)].slip_end.head(d - 1).transpose();
  }
  preload.displacement = point.displacement;
  preload.force = point.force;
  preload.slip_origin = joint.condition.slip_origin;
  preload.pressure.resize(nodes);
  preload.friction_use = Eigen::VectorXd::Zero(nodes);
  for (Eigen::Index i = 0; i < nodes; ++i) {
    const double normal = preload.force(i * d), limit = model->contact_law(i).limit(normal).force;
    preload.pressure(i) = normal / contact.area(i);
    if (limit > 0) preload.friction_use(i) = preload.force.segment(i * d + 1, d - 1).norm() / limit;
  }
  const dynamics::CondensedHarmonic at = model->harmonic(0, 0);
  preload.full_displacement = model->recover(at, preload.displacement.cast<std::complex<double>>()).real();
  return preload;
}

}  // namespace dovetail::steady
