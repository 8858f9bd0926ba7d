#pragma once

#include <cmath>
#include <map>
#include <string>

#include "optimizer/accuracy/choice.hpp"
#include "steady/work.hpp"

namespace dovetail::optimizer {

inline constexpr const char* kVolume = "asymptotic_wear_volume_m3";

/// Of all that follows the matrices, a little off the powers that are expected.
inline double contact_operations(const Settings& s) {
  return 3e9 * std::pow(s.mesh, 1.1) * std::pow((2.0 * s.harmonics + 1) / 11, 1.3) * std::pow(s.samples / 128.0, 0.5) *
         (1 - 0.1 * std::log10(s.resonance_tolerance / 1e-7));
}

/// The matrices with it.
inline double operations(const Settings& s) {
  return 6e9 * std::pow(s.mesh, 0.45) * std::pow(s.beside, 0.9) * std::pow(s.modes / 20.0, 0.3) + contact_operations(s);
}

/// A design whose bars fall with powers of the settings, not quite those that are expected of it.
struct Laws {
  double mesh = 0.03, beside = 0.004, harmonics = 0.03, samples = 0.01, modes = 0.002,
         history = 0.1;  ///< at the scene's own
  double search = 5e-5;
  double by_mesh = 1.7, by_harmonics = 2.5, by_samples = 1.5;

  [[nodiscard]] std::map<std::string, double> at(const Settings& s) const {
    return {{"mesh", mesh * std::pow(s.mesh, -by_mesh) + left_beside(s)},
            {"harmonics", harmonics * std::pow((2.0 * s.harmonics + 1) / 11, -by_harmonics)},
            {"samples", samples * std::pow(s.samples / 128.0, -by_samples)},
            {"modes", modes * std::pow(s.modes / 20.0, -2.0)},
            {"search", search * s.resonance_tolerance / 1e-7},
            {"history", history}};
  }
  [[nodiscard]] double left_beside(const Settings& s) const { return beside * std::pow(s.beside, -by_mesh); }
  [[nodiscard]] double sum(const Settings& s) const {
    double sum = -history;
    for (const auto& [source, bar] : at(s)) sum += bar;
    return sum;
  }
  [[nodiscard]] AccuracyProbe probe(int* calls = nullptr) const {
    return [*this, calls](const Settings& s) -> AccuracyAnswer {
      if (calls != nullptr) ++*calls;
      Evaluation evaluation;
      evaluation.responses[kVolume] = 1;
      evaluation.error_sources[kVolume] = at(s);
      const double nodes = std::round(34 * std::sqrt(s.mesh));
      evaluation.model = {
          {"dofs", 16000 * std::pow(s.mesh, 0.4) * std::pow(s.beside, 0.8)},
          {"contact_nodes", nodes},
          {"wear_history_may_differ", 1},
          {"jacobians_spent", contact_operations(s) / steady::jacobian_operations(static_cast<Eigen::Index>(nodes), 2,
                                                                                  s.harmonics, s.samples)}};
      return {evaluation, {{kVolume, left_beside(s)}}};
    };
  }
};

inline const AccuracyGoal kGoal{.relative = 0.02, .responses = {kVolume}};

}  // namespace dovetail::optimizer
