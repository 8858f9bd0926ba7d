#include "studies/program/engine/truncation_choice.hpp"

#include <fmt/format.h>

#include <numbers>

#include "quality/automatic.hpp"

namespace dovetail::studies {

double accuracy(const SolverChoice& solver) {
  return solver.accuracy.value_or(quality::AutomaticOptions{}.amplitude_tolerance);
}

std::optional<Status> choose_truncation(LoadedModel& loaded, const std::vector<double>& hz,
                                        const SolverChoice& solver) {
  if (!solver.automatic()) return std::nullopt;
  std::vector<double> omega;
  for (const double f : hz) omega.push_back(2 * std::numbers::pi * f);
  quality::AutomaticOptions options;
  options.harmonics = solver.harmonics == kAutomatic;
  options.samples = solver.samples == kAutomatic;
  options.amplitude_tolerance = accuracy(solver);
  options.energy_tolerance = 10 * accuracy(solver);
  const quality::AutomaticSettings chosen = quality::automatic_settings(loaded.joint, omega, options);
  loaded.joint.options = chosen.options;
  return chosen.status;
}

std::string truncation_complaint(Status status, const steady::Options& reached, const SolverChoice& solver) {
  if (status == Status::iteration_limit)
    return fmt::format("the accuracy {:g} is not reached with {} harmonics and {} samples", accuracy(solver),
                       reached.harmonics, reached.samples);
  return fmt::format("harmonics and samples could not be chosen: a state needed for it did not converge: {}",
                     to_string(status));
}

}  // namespace dovetail::studies
