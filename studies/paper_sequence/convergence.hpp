#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "core/enum_names.hpp"
#include "optimizer/problem/outcome.hpp"
#include "optimizer/scene/scene.hpp"

namespace dovetail::paper_sequence {

/// What is changed.
enum class Refined { mesh, modes, harmonics, samples };
constexpr EnumNames<Refined, 4> enum_names(Refined) {
  return {{{Refined::mesh, "mesh"},
           {Refined::modes, "modes"},
           {Refined::harmonics, "harmonics"},
           {Refined::samples, "samples"}}};
}
[[nodiscard]] constexpr std::string_view to_string(Refined kind) {
  return name_of(kind);
}

/// What the sequence stands on, computed with one setting changed.
struct ConvergenceRow {
  Refined kind = Refined::mesh;
  std::string setting = {};  ///< "10 x 6 contact elements per flank, 61 000 unknowns"
  bool reference = false;    ///< as the study
  std::string status = optimizer::status_of(optimizer::Outcome::converged);
  double frequency_hz = 0;      ///< unworn resonance
  double pressure_mean_pa = 0;  ///< after spin-up
  double pressure_max_pa = 0;   ///< of the nodes, the sharp edges included
  double energy_j = 0;          ///< dissipated per period at the unworn resonance
  double volume_m3 = 0;         ///< worn off when wear has come to rest there
  double seconds = 0;
};

struct ConvergenceOptions {
  std::vector<double> mesh_factors{1.6, 1.25, 1, 0.8};  ///< on all element sizes, coarsest first
  std::vector<int> modes{10, 20, 40};
  std::vector<int> harmonics{1, 3, 5, 7};
  std::vector<int> samples{64, 128, 256, 512};
  std::function<void(const std::string&)> progress = {};
};

/// The same quantities over mesh, modes, harmonics and samples, one of them changed at a time. The study's own number
/// is added to a list without it; the mesh factors are to hold 1. Cost: a whole evaluation per mesh and number of
/// modes, less for the others.
[[nodiscard]] std::vector<ConvergenceRow> convergence(const optimizer::Scene& scene, const ConvergenceOptions& options);

/// A table for the page: changes against the study's setting.
[[nodiscard]] std::string convergence_table(const std::vector<ConvergenceRow>& rows);

}  // namespace dovetail::paper_sequence
