#pragma once

#include <string_view>

#include "core/enum_names.hpp"
#include "wear/follow.hpp"

/// How wear may be asked for.
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

}  // namespace dovetail::studies
