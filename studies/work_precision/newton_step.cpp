#include "studies/work_precision/newton_step.hpp"

#include "numerics/dense_lu.hpp"
#include "steady/tangent.hpp"
#include "studies/work_precision/processor_time.hpp"

namespace dovetail::work_precision {

PatchState solve_patch(const PatchOptions& options, int harmonics, int samples) {
  PatchState patch;
  patch.model = std::make_shared<const dynamics::CondensedModel>(contact_patch(options));
  const steady::Options steady{.harmonics = harmonics, .samples = samples};
  patch.state = steady::steady_state({patch.model, {}, steady}, kPatchFrequency);
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
  const steady::Problem& residual = patch.residual();
  const Eigen::MatrixXd& at = patch.state.displacement;
  times.unknowns = residual.unknowns();
  times.factorised = patch.state.tangent->factorised_size();

  steady::Point state;
  times.residual = median_seconds([&] { residual.evaluate(at, false, state); }, seconds);
  times.derivative = median_seconds([&] { residual.evaluate(at, true, state); }, seconds);
  Eigen::MatrixXd jacobian;
  times.jacobian = median_seconds([&] { jacobian = residual.jacobian(state); }, seconds);
  times.lu = median_seconds([&] { const numerics::DenseLu lu(jacobian); }, seconds);
  const Eigen::VectorXd rhs = Eigen::VectorXd::Ones(residual.unknowns());
  times.linearise = median_seconds([&] { const steady::Tangent linear(residual, state); }, seconds);
  const steady::Tangent linear(residual, state);
  times.solve = median_seconds([&] { const Eigen::MatrixXd step = linear.solve(rhs); }, seconds);
  times.step = median_seconds(
      [&] {
        residual.evaluate(at, true, state);
        const steady::Tangent now(residual, state);
        const Eigen::MatrixXd step = now.solve(state.residual.reshaped());
      },
      seconds);
  return times;
}

}  // namespace dovetail::work_precision
