#include "studies/work_precision/evaluations/setting.hpp"

#include <fmt/format.h>

#include <cmath>

namespace dovetail::work_precision {

WholeSetting whole_setting(const optimizer::Scene& scene) {
  return {.mesh = 1,
          .beside = 1,
          .harmonics = scene.solver.harmonics,
          .samples = scene.solver.samples,
          .modes = scene.solver.modes,
          .resonance_tolerance = scene.solver.resonance_tolerance,
          .history_tolerance = scene.solver.history_tolerance,
          .tolerance = scene.solver.tolerance,
          .solver = scene.solver.solver};
}

WholeSetting with_choice(WholeSetting setting, const optimizer::Scene& scene, const optimizer::Settings& chosen) {
  setting.mesh = chosen.mesh;
  setting.beside = optimizer::chooses_beside(scene, {}) ? chosen.beside / chosen.mesh : 1;
  setting.harmonics = chosen.harmonics;
  setting.samples = chosen.samples;
  setting.modes = chosen.modes;
  setting.resonance_tolerance = chosen.resonance_tolerance;
  setting.history_tolerance = chosen.history_tolerance;
  return setting;
}

optimizer::Scene with_setting(const optimizer::Scene& scene, const WholeSetting& setting) {
  optimizer::Scene there = optimizer::with_settings(scene, {.mesh = setting.mesh,
                                                            .beside = setting.mesh * setting.beside,
                                                            .harmonics = setting.harmonics,
                                                            .samples = setting.samples,
                                                            .modes = setting.modes,
                                                            .resonance_tolerance = setting.resonance_tolerance,
                                                            .history_tolerance = setting.history_tolerance});
  there.solver.tolerance = setting.tolerance;
  there.solver.solver = setting.solver;
  return there;
}

int edges(const WholeSetting& setting, int edges_of_file) {
  return static_cast<int>(std::lround(setting.mesh * edges_of_file));
}

std::string beside_words(const WholeSetting& setting) {
  return setting.beside == 1 ? "" : fmt::format("{:.2g} times as many beside the flanks", setting.beside);
}

std::string setting_words(const WholeSetting& setting, int edges_of_file) {
  constexpr WholeSetting kDefaults;
  std::string text = fmt::format("{} edges", edges(setting, edges_of_file));
  if (const std::string beside = beside_words(setting); !beside.empty()) text += " (" + beside + ")";
  text += fmt::format(", H = {}, N = {}, {} modes", setting.harmonics, setting.samples, setting.modes);
  if (setting.resonance_tolerance != kDefaults.resonance_tolerance)
    text += fmt::format(", resonance to {:g}", setting.resonance_tolerance);
  if (setting.history_tolerance != kDefaults.history_tolerance)
    text += fmt::format(", history to {:g}", setting.history_tolerance);
  if (setting.tolerance != kDefaults.tolerance) text += fmt::format(", residual to {:g}", setting.tolerance);
  if (setting.solver != kDefaults.solver) text += ", " + std::string(to_string(setting.solver));
  return text;
}

}  // namespace dovetail::work_precision
