#pragma once

#include "studies/program/engine/wear_methods.hpp"
#include "wear/asymptote/spread.hpp"

namespace dovetail::studies {

/// How far harmonics, samples and pseudo-penalty may have moved a worn state; infinite: unknown.
struct WearBars {
  double worn_volume = 0;    ///< m^3
  double largest_depth = 0;  ///< m
};

/// Error bars of the worn state `answer`: it is computed again from the unworn joint at the settings of
/// quality::error_bars, at its own resonance or, for the worst of a band, at that one's frequency.
[[nodiscard]] WearBars worn_bars(const WearOptions& options, const LoadedModel& loaded, const WearStart& at,
                                 const WearAnswer& answer, const wear::Watcher& watcher);

/// How the worn state depends on what is not known. Every member is computed as the answer was: at the frequency given,
/// or at its own resonance.
[[nodiscard]] wear::Spread worn_spread(const WearOptions& options, const LoadedModel& loaded, const WearStart& at,
                                       const WearAnswer& answer, const wear::Watcher& watcher);

}  // namespace dovetail::studies
