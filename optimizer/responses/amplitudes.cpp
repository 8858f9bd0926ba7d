// How far the aerofoil's tip vibrates.
#include "optimizer/candidate/candidate_result.hpp"
#include "optimizer/responses/response_table.hpp"

namespace dovetail::optimizer {

const Response kPeakAmplitude{
    .name = "peak_amplitude_m",
    .unit = "m",
    .help = "Amplitude of the aerofoil tip at the unworn resonance.",
    .stage = Stage::unworn,
    .value = [](const Scene&, const CandidateResult& result) { return result.unworn->amplitude; },
    .mesh_order = {1.6},
    .off = [](const CandidateResult& result, const LeftOpen& open) -> std::optional<double> {
      if (!open.slip_energy) return {};
      // What friction takes from a vibration is a part of what the load brings, and the amplitude changes by that part.
      return result.unworn->amplitude * *open.slip_energy / result.unworn->state.input_energy;
    }};

const Response kWornPeakAmplitude{
    .name = "worn_peak_amplitude_m",
    .unit = "m",
    .help = "Amplitude of the aerofoil tip at the worn resonance.",
    .stage = Stage::worn_resonance,
    .value = [](const Scene&, const CandidateResult& result) { return result.worn->amplitude; },
    .mesh_order = {1.5},
    .grid_order = 7.0 / 3,
    .unworn = &kPeakAmplitude,
    .off = [](const CandidateResult&, const LeftOpen& open) { return open.worn_amplitude; }};

}  // namespace dovetail::optimizer
