#pragma once

#include <string>

#include "optimizer/accuracy/settings.hpp"
#include "optimizer/scene/scene.hpp"

namespace dovetail::work_precision {

/// What the accuracy of a whole evaluation is bought with.
struct WholeSetting {
  double mesh = 1;    ///< edges of the mesh over those of the study file
  double beside = 1;  ///< the same beside the flanks of a section, over those along them
  int harmonics = optimizer::SolverSettings{}.harmonics;
  int samples = optimizer::SolverSettings{}.samples;
  int modes = optimizer::SolverSettings{}.modes;
  double resonance_tolerance = optimizer::SolverSettings{}.resonance_tolerance;
  double history_tolerance = optimizer::SolverSettings{}.history_tolerance;
  double tolerance = optimizer::SolverSettings{}.tolerance;  ///< of the residual of a steady state
  steady::Solver solver = steady::Solver::automatic;

  auto operator<=>(const WholeSetting&) const = default;  // NOLINT(modernize-use-nullptr): there is no pointer here
};

/// That of a scene on the mesh of its file.
[[nodiscard]] WholeSetting whole_setting(const optimizer::Scene& scene);
/// The same with what an accuracy chooses of a scene.
[[nodiscard]] WholeSetting with_choice(WholeSetting setting, const optimizer::Scene& scene,
                                       const optimizer::Settings& chosen);
/// The scene with it.
[[nodiscard]] optimizer::Scene with_setting(const optimizer::Scene& scene, const WholeSetting& setting);

/// "24 edges, H = 5, N = 128, 20 modes", and tolerances and solver where they are not the program's defaults.
[[nodiscard]] std::string setting_words(const WholeSetting& setting, int edges_of_file);
/// "0.5 times as many beside the flanks", or nothing.
[[nodiscard]] std::string beside_words(const WholeSetting& setting);
/// "24", of the mesh.
[[nodiscard]] int edges(const WholeSetting& setting, int edges_of_file);

}  // namespace dovetail::work_precision
