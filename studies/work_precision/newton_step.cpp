#include "studies/work_precision/newton_step.hpp"

#include "numerics/dense_lu.hpp"
#include "paths/steady_state.hpp"
#include "steady/tangent.hpp"
#include "studies/ready_study/processor_time.hpp"

namespace dovetail::work_precision {

using ready_study::median_seconds;

PatchState solve_patch(const PatchOptions& options, int harmonics, int samples) {
  PatchState patch;
  patch.model = std::make_shared<const dynamics::CondensedModel>(contact_patch(options));
  const steady::Options steady{.harmonics = harmonics, .samples = samples};
  patch.state = paths::steady_state({patch.model, {}, steady}, kPatchFrequency);
  for (const steady::NodeSummary& node : patch.state.nodes) {
    patch.stuck += node.stuck;
    patch.slipping += node.slips;
    patch.separating += node.separates;
  }
  return patch;
}

StepTimes measure_step(const PatchOptions& options, int harmonics, int samples, double seconds) {
  const PatchState patch = solve_patch(options, harmonics, samples);
  StepTimes times{.status = patch.state.status,
                  .nodes = options.nodes,
                  .harmonics = harmonics,
                  .samples = samples,
                  .stuck = patch.stuck};
  if (!patch.converged()) return times;
  const std::shared_ptr<const steady::Problem>& problem = patch.problem();
  const Eigen::MatrixXd& at = patch.state.displacement;
  times.unknowns = problem->unknowns();
  times.factorised = patch.state.tangent->factors().size();

  const auto point = std::make_shared<steady::Point>();
  times.residual = median_seconds([&] { steady::evaluate(problem, at, *point); }, seconds);
  const auto derivative = [&] {
    steady::evaluate(problem, at, *point);
    steady::differentiate(*point);
  };
  times.derivative = median_seconds(derivative, seconds);
  Eigen::MatrixXd jacobian;
  times.jacobian = median_seconds([&] { jacobian = steady::jacobian(*point); }, seconds);
  times.lu = median_seconds([&] { const numerics::DenseLu lu(jacobian); }, seconds);
  const Eigen::VectorXd rhs = Eigen::VectorXd::Ones(problem->unknowns());
  times.linearise = median_seconds([&] { const steady::Tangent tangent(point); }, seconds);
  const steady::Tangent tangent(point);
  times.solve = median_seconds([&] { const Eigen::MatrixXd step = tangent.solve(rhs); }, seconds);
  times.step = median_seconds(
      [&] {
        derivative();
        const steady::Tangent now(point);
        const Eigen::MatrixXd step = now.solve(point->residual.reshaped());
      },
      seconds);
  return times;
}

}  // namespace dovetail::work_precision
