#pragma once

#include <array>
#include <functional>
#include <memory>
#include <string>

#include "dynamics/condensed_model.hpp"
#include "optimizer/problem/outcome.hpp"
#include "optimizer/scene/scene.hpp"
#include "paths/resonance.hpp"
#include "steady/options.hpp"

namespace dovetail::work_precision {

/// What is varied. The values here are the defaults of the program.
struct Setting {
  int harmonics = steady::Options{}.harmonics;
  int samples = steady::Options{}.samples;
  double penalty = steady::Options{}.penalty_scale;  ///< ratio to the automatic pseudo-penalty
  steady::Solver solver = steady::Options{}.solver;
  contact::SlipReturn slip_return = steady::Options{}.slip_return;
  /// Other penalties and ways are tried when a solve fails.
  bool cascade = steady::Options{}.penalty_cascade;
  int modes = optimizer::SolverSettings{}.modes;              ///< of the reduction, where there is one
  int flank_elements = geometry::MeshSizes{}.flank_elements;  ///< along a flank; all other sizes follow

  bool operator==(const Setting&) const = default;
};

/// What is looked at, at the resonance.
inline constexpr std::array<const char*, 3> kQuantities{"resonance frequency", "dissipated energy", "peak amplitude"};
inline constexpr std::array<const char*, 3> kQuantityKeys{"resonance_rad_per_s", "dissipated_energy_j",
                                                          "peak_amplitude"};

/// One computation.
struct Run {
  Setting setting;
  std::string status = optimizer::status_of(optimizer::Outcome::converged);  ///< or why not: "preload: iteration_limit"
  std::array<double, 3> value = {};  ///< rad/s, J per cycle, half peak-to-peak; only when converged
  double seconds = 0;                ///< processor time of the resonance search, median
  double model_seconds = 0;          ///< of everything before it: mesh, elements, reduction, preload
  int solves = 0, jacobians = 0;
  int contact_nodes = 0, stuck = 0, slipping = 0, separating = 0;  ///< one that slips may also separate

  [[nodiscard]] bool converged() const { return optimizer::converged(status); }
};

/// Computes the resonance of one model with a setting.
using Subject = std::function<Run(const Setting&)>;

/// Resonance search on a condensed model near `omega_start` (rad/s), repeated for its time: five times or until
/// `seconds` have passed. Fills all but model_seconds.
[[nodiscard]] Run timed_resonance(const std::shared_ptr<const dynamics::CondensedModel>& model, double omega_start,
                                  const Setting& setting, double tolerance, double seconds);

/// |a - b| / |b| of each quantity.
[[nodiscard]] std::array<double, 3> relative_difference(const Run& a, const Run& b);

}  // namespace dovetail::work_precision
