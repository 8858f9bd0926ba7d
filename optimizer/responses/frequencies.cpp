// Frequencies of the followed mode: glued, with friction, worn, and how far wear moves it.
#include "optimizer/candidate/candidate_result.hpp"
#include "optimizer/responses/response_table.hpp"

namespace dovetail::optimizer {

namespace {

constexpr MeshOrder kFrequency{.in_plane = 1.5, .in_space = 2.5};

}  // namespace

const Response kGluedFrequency{
    .name = "glued_frequency_hz",
    .unit = "Hz",
    .help = "Natural frequency of the followed mode with the flanks glued at their asperities, at speed.",
    .stage = Stage::model,
    .value =
        [](const Scene& scene, const CandidateResult& result) {
          // Glued on all of the mesh; how much softer asperities make that is known between contact nodes.
          const int mode = scene.loading.mode - 1;
          const double softer = result.model.glued_frequencies(mode) / result.model.reduction.glued_frequencies(mode);
          return hertz(reduction::glued_frequencies(result.model.matrices.trace)(mode) * softer);
        },
    .mesh_order = kFrequency};

const Response kResonance{
    .name = "resonance_hz",
    .unit = "Hz",
    .help = "Frequency of the largest amplitude of the followed mode, unworn, with friction.",
    .stage = Stage::unworn,
    .value = [](const Scene&, const CandidateResult& result) { return hertz(result.unworn->omega); },
    .mesh_order = kFrequency,
    .off = [](const CandidateResult& result, const LeftOpen& open) -> std::optional<double> {
      if (!open.frequency) return {};
      return *open.frequency * hertz(result.unworn->omega);
    }};

const Response kWornResonance{
    .name = "worn_resonance_hz",
    .unit = "Hz",
    .help = "The same after wear has come to rest.",
    .stage = Stage::worn_resonance,
    .value = [](const Scene&, const CandidateResult& result) { return hertz(result.worn->omega); },
    .mesh_order = kFrequency,
    .unworn = &kResonance,
    .off = [](const CandidateResult& result, const LeftOpen& open) -> std::optional<double> {
      if (!open.drift && !open.frequency) return {};
      return open.drift.value_or(0) * hertz(result.unworn->omega) +
             open.frequency.value_or(0) * hertz(result.worn->omega);
    }};

// Most of the worn joint bears on its inner parts, and of two frequencies on one mesh the ends of flanks cancel.
const Response kResonanceDrift{.name = "resonance_drift",
                               .unit = "",
                               .help = "Worn over unworn resonance frequency, minus one.",
                               .stage = Stage::worn_resonance,
                               .value = [](const Scene&, const CandidateResult& result) { return drift(result); },
                               .mesh_order = {2.5},
                               .grid_order = 7.0 / 3,
                               .by_zone_ends = true,
                               .either_sign = true,
                               .off = [](const CandidateResult&, const LeftOpen& open) -> std::optional<double> {
                                 if (!open.drift && !open.frequency) return {};
                                 return open.drift.value_or(0) + 2 * open.frequency.value_or(0);
                               }};

}  // namespace dovetail::optimizer
