#include "studies/work_precision/setting.hpp"

#include <cmath>

#include "studies/ready_study/processor_time.hpp"

namespace dovetail::work_precision {

using ready_study::median, ready_study::processor_seconds;

Run timed_resonance(const std::shared_ptr<const dynamics::CondensedModel>& model, double omega_start,
                    const Setting& setting, double tolerance, double seconds) {
  // Without fall-backs, auto is Newton's method, and a search that fails is not continued along the branch.
  const bool bare = !setting.cascade;
  const steady::Options steady{
      .harmonics = setting.harmonics,
      .samples = setting.samples,
      .tolerance = tolerance,
      .solver = bare && setting.solver == steady::Solver::automatic ? steady::Solver::newton : setting.solver,
      .penalty_scale = setting.penalty,
      .penalty_cascade = setting.cascade,
      .slip_return = setting.slip_return};
  paths::ResonanceOptions search;
  if (bare) search.sweep_range = 0;
  paths::Resonance found;
  std::vector<double> times;
  double spent = 0;
  while (times.size() < 5 && (times.empty() || spent < seconds)) {
    const double before = processor_seconds();
    found = paths::resonance({model, {}, steady}, omega_start, search);
    times.push_back(processor_seconds() - before);
    spent += times.back();
  }
  Run run;
  run.setting = setting;
  run.seconds = median(times);
  run.solves = found.solves;
  run.jacobians = found.jacobians;
  run.contact_nodes = static_cast<int>(found.state.nodes.size());
  for (const steady::NodeSummary& node : found.state.nodes) {
    run.stuck += node.stuck;
    run.slipping += node.slips;
    run.separating += node.separates;
  }
  if (found.status == Status::converged)
    run.value = {found.omega, found.state.friction_energy, found.amplitude};
  else
    run.status = optimizer::failed_at("resonance", found.status);
  return run;
}

std::array<double, 3> relative_difference(const Run& a, const Run& b) {
  std::array<double, 3> result{};
  for (std::size_t q = 0; q < result.size(); ++q) result[q] = std::abs(a.value[q] / b.value[q] - 1);
  return result;
}

}  // namespace dovetail::work_precision
