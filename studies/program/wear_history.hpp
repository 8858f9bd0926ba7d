#pragma once

#include <optional>
#include <string>
#include <vector>

#include "studies/program/commands.hpp"
#include "studies/program/engine.hpp"
#include "wear/control.hpp"
#include "wear/history.hpp"

namespace dovetail::studies {

struct WearStart;

/// How a history was computed, for its answer.
struct HistoryChoice {
  std::string integrator = "explicit";  ///< explicit | implicit
  wear::HistoryOptions options;         ///< as used; of an implicit history only what it shares
  double depth_scale = 0;               ///< m, of which the increment is a hundredth by default; 0: not computed
  std::string resumed_from;             ///< the file, or empty
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

/// The history asked for from `condition`, or on from the one in the file of --resume. Throws InputError for a file
/// that is no history of this model.
[[nodiscard]] ComputedHistory compute_history(const WearOptions& options, const LoadedModel& loaded,
                                              const WearStart& at, const response::ContactCondition& condition,
                                              const wear::Control& control);

/// A history as `dovetail wear --json` wrote it, with what resuming needs; increment 0: not known.
struct StoredHistory {
  wear::History history;
  double increment = 0;
};
[[nodiscard]] StoredHistory read_history(const std::string& file, Eigen::Index nodes);

/// Response curves of the joint as worn at --curves states, evenly spaced in worn volume from the first to the last.
/// Without --curve-from and --curve-to their frequencies lie around the resonances of both, by three times the distance
/// at which the first one has lost half its amplitude.
[[nodiscard]] std::vector<WornCurve> worn_curves(const WearOptions& options, const LoadedModel& loaded,
                                                 const wear::History& history, const wear::Control& control);

}  // namespace dovetail::studies
