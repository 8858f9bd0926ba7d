#pragma once

#include <array>
#include <boost/range/adaptor/indirected.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "optimizer/responses/response.hpp"

namespace dovetail::optimizer {

// Each stands in a file of this folder, some beside their relatives. A new one is a file, and its name here twice.
extern const Response kWornVolume, kWornDepth, kInitialWearRate, kResonance, kWornResonance, kResonanceDrift,
    kPeakAmplitude, kWornPeakAmplitude, kMass, kPeakStress, kContactPressureMax, kContactPressureMean, kNeckTension,
    kBladeFilletStress, kDiskFilletStress, kPostWidth, kDissipatedEnergy, kGluedFrequency;

/// Of all cases of load together.
extern const Response kMissionVolume, kMissionDepth, kMissionDrift;

/// All responses of one case, in the order of the reports.
inline constexpr std::array kResponses{&kWornVolume,    &kWornDepth,          &kInitialWearRate,
                                       &kResonance,     &kWornResonance,      &kResonanceDrift,
                                       &kPeakAmplitude, &kWornPeakAmplitude,  &kMass,
                                       &kPeakStress,    &kContactPressureMax, &kContactPressureMean,
                                       &kNeckTension,   &kBladeFilletStress,  &kDiskFilletStress,
                                       &kPostWidth,     &kDissipatedEnergy,   &kGluedFrequency};

/// Those of all cases that act in turn on the same flanks, see MissionResult.
inline constexpr std::array kMissionResponses{&kMissionVolume, &kMissionDepth, &kMissionDrift};

/// The ones of one case to go through. An evaluation may leave some out, never add others.
[[nodiscard]] inline auto responses() {
  return boost::adaptors::indirect(kResponses);
}

/// The others.
[[nodiscard]] inline auto mission_responses() {
  return boost::adaptors::indirect(kMissionResponses);
}

/// Whether one of these is of all cases together.
[[nodiscard]] bool of_a_mission(const std::vector<std::string>& names);

/// Names of all responses, those of one case first.
[[nodiscard]] std::vector<std::string> response_names();

/// The last stage that one of these needs; unknown names need none.
[[nodiscard]] Stage last_stage(const std::vector<std::string>& names);

/// Whether one of these asks for a finer mesh.
[[nodiscard]] bool by_finer_mesh(const std::vector<std::string>& names);

/// The entry of that name, of either kind, or nullptr.
[[nodiscard]] const Response* find_response(std::string_view name);

}  // namespace dovetail::optimizer
