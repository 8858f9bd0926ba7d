#pragma once

#include "studies/program/answers/json.hpp"
#include "studies/program/engine/wear_methods.hpp"
#include "wear/asymptote/spread.hpp"

namespace dovetail::studies {

/// Error bars of the worn state `answer`: it is computed again from the unworn joint at the settings of
/// quality::error_bars, at its own resonance or, for the worst of a band, at that one's frequency.
[[nodiscard]] WearBars worn_bars(const WearOptions& options, const LoadedModel& loaded, const WearStart& at,
                                 const WearAnswer& answer, const wear::Watcher& watcher);

/// How the worn state depends on what is not known. Every member is computed as the answer was: at the frequency given,
/// or at its own resonance.
[[nodiscard]] wear::Spread worn_spread(const WearOptions& options, const LoadedModel& loaded, const WearStart& at,
                                       const WearAnswer& answer, const wear::Watcher& watcher);

}  // namespace dovetail::studies
