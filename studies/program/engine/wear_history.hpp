#pragma once

#include <optional>
#include <string>
#include <vector>

#include "studies/program/engine/loaded_model.hpp"
#include "studies/program/engine/stored_history.hpp"
#include "studies/program/questions/wear_options.hpp"
#include "wear/history/history.hpp"
#include "wear/watcher.hpp"

namespace dovetail::studies {

struct WearStart;

/// How a history was computed, for its answer.
struct HistoryChoice {
  wear::HistoryOptions options;         ///< as used
  double start_cycles = 0;              ///< done by the history that it goes on with
  double depth_scale = 0;               ///< m, of which the increment is a hundredth by default; 0: not computed
  std::string resumed_from;             ///< the file, or empty
  std::vector<IdentityEntry> identity;  ///< what a history that goes on with this one must share with it
};

/// Response of the joint as worn at one state of a history.
struct WornCurve {
  double cycles = 0, worn_volume = 0;  ///< m^3
  std::vector<double> frequency_hz;
  std::vector<double> amplitude = {};  ///< m; NaN where it did not converge
};

struct ComputedHistory {
  wear::History history;
  HistoryChoice choice;
};

/// The history asked for from `condition`, or on from the one in the file of --resume: the result then begins with that
/// one's states and is the one that was never stopped, to the residuals of steady states (where --cycles stopped it a
/// state more: to the error of the steps). A file's history that had come to its end is the result itself. Throws
/// InputError for a file that is no history of this model at these settings, or one that is past --cycles.
[[nodiscard]] ComputedHistory compute_history(const WearOptions& options, const LoadedModel& loaded,
                                              const WearStart& at, const wear::Watcher& watcher);

/// Response curves of the joint as worn at --curves states, evenly spaced in worn volume from the first to the last.
/// Without --curve-from and --curve-to their frequencies lie around the resonances of both, by three times the distance
/// at which the first one has lost half its amplitude.
[[nodiscard]] std::vector<WornCurve> worn_curves(const WearOptions& options, const LoadedModel& loaded,
                                                 const wear::History& history, const wear::Watcher& watcher);

}  // namespace dovetail::studies
