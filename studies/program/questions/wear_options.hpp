#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/enum_names.hpp"
#include "studies/program/questions/solver_choice.hpp"
#include "studies/program/questions/tell_choice.hpp"
#include "wear/follow.hpp"
#include "wear/history/history.hpp"

// How wear may be asked for.
namespace dovetail::studies {

/// What finds the worn state.
enum class WearMethod {
  history,    ///< over cycles
  asymptote,  ///< directly
};
constexpr EnumNames<WearMethod, 2> enum_names(WearMethod) {
  return {{{WearMethod::history, "history"}, {WearMethod::asymptote, "asymptote"}}};
}
[[nodiscard]] constexpr std::string_view to_string(WearMethod method) {
  return name_of(method);
}

/// What drives the wear.
enum class Drive {
  fixed,      ///< one frequency
  resonance,  ///< that of the joint as it wears
  band,       ///< each of several frequencies; the worst of them is the answer
};
constexpr EnumNames<Drive, 3> enum_names(Drive) {
  return {{{Drive::fixed, "fixed"}, {Drive::resonance, "resonance"}, {Drive::band, "band"}}};
}
[[nodiscard]] constexpr std::string_view to_string(Drive drive) {
  return name_of(drive);
}

[[nodiscard]] constexpr Drive drive_of(wear::Follow follow) {
  return follow == wear::Follow::resonance ? Drive::resonance : Drive::fixed;
}
/// Of one computation: each frequency of a band is held.
[[nodiscard]] constexpr wear::Follow follow_of(Drive drive) {
  return drive == Drive::resonance ? wear::Follow::resonance : wear::Follow::fixed;
}

struct WearOptions {
  std::string input;             ///< MODEL.h5 or STUDY.toml
  std::vector<std::string> set;  ///< KEY=VALUE, as given with --set
  SolverChoice solver;
  WearMethod method = WearMethod::asymptote;
  std::optional<Drive> follow;         ///< absent: as the study says, or fixed
  std::optional<double> frequency_hz;  ///< absent: the unworn resonance
  std::optional<double> band_from_hz, band_to_hz;
  std::optional<int> band_points;           ///< absent: 11
  std::optional<double> cycles;             ///< history
  std::optional<int> steps;                 ///< history
  std::optional<double> increment_m;        ///< history; absent: a hundredth of the depth that release comes to
  std::optional<double> history_tolerance;  ///< of a history, or of the one that decides where an asymptote is in doubt
  std::optional<wear::IntegratorKind> integrator;  ///< of a history; absent: as the wear law asks for
  std::string resume;                              ///< JSON of the history to go on with, or empty
  std::optional<int> curves;                       ///< response curves along a history
  std::optional<int> curve_points;                 ///< of each; absent: 60
  std::optional<double> curve_from_hz, curve_to_hz;
  bool error_bars = false;
  bool spread = false;
  std::string json;
  TellChoice tell = {};
};

}  // namespace dovetail::studies
