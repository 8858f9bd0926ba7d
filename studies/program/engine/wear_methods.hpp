#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "paths/resonance.hpp"
#include "studies/program/engine/loaded_model.hpp"
#include "studies/program/engine/wear_history.hpp"
#include "studies/program/questions/wear_options.hpp"
#include "wear/asymptote/asymptote.hpp"
#include "wear/history/history.hpp"
#include "wear/watcher.hpp"

namespace dovetail::studies {

/// Where the excitation of a wear computation begins.
struct WearStart {
  double hz = 0;  ///< exactly as asked for
  double omega = 0;
  std::optional<paths::Resonance> resonance;  ///< the unworn one, when no frequency was asked for

  [[nodiscard]] bool found() const { return !resonance || resonance->status == Status::converged; }
};

/// The frequency asked for, or the unworn resonance. Throws InputError when there is none to look for.
[[nodiscard]] WearStart wear_start(const WearOptions& options, const LoadedModel& loaded);
[[nodiscard]] WearStart wear_start_at(double hz);

/// What either method came to; the one not asked for is empty.
struct WearAnswer {
  std::optional<wear::Asymptote> asymptote;
  std::optional<wear::History> history;
  HistoryChoice choice;           ///< of the history
  std::vector<WornCurve> curves;  ///< along the history, when asked for
  wear::Verdict status = wear::Verdict::not_converged;
  Status solver = Status::converged;
  std::string reason;  ///< why it did not converge, where `solver` does not say it
  std::vector<double> frequencies_hz;
  double volume = 0;      ///< m^3, of the last state, worn out or not
  Eigen::VectorXd depth;  ///< [Nc] m, of the last state
  int solves = 0;

  /// Whether volume and depth are those of a state, not of an attempt that failed before any or of wear without end.
  [[nodiscard]] bool known() const {
    return history ? history->cycles.size() > 0 : asymptote && asymptote->verdict == wear::Verdict::asymptote;
  }
  [[nodiscard]] bool worn_out() const { return status == wear::Verdict::asymptote; }
  [[nodiscard]] double largest_depth() const { return depth.size() > 0 ? depth.maxCoeff() : 0; }
};

/// not_converged also of a history that ended at the cycles asked for while it wore.
[[nodiscard]] wear::Verdict wear_status(const wear::History& history);

/// The answer of a computation that failed before it had any state.
[[nodiscard]] WearAnswer unknown_answer(const WearOptions& options, Eigen::Index nodes, Status why);

/// The worn state by the method asked for, the excitation held or tracking the resonance.
[[nodiscard]] WearAnswer wear_answer(const WearOptions& options, const LoadedModel& loaded, const WearStart& at,
                                     const wear::Watcher& watcher);

/// Worn states over a band of held frequencies.
struct WearBand {
  std::vector<double> frequencies_hz;
  std::vector<wear::Verdict> status;
  std::vector<double> volume, largest_depth;  ///< with edges between nodes where placed; NaN where not known
  std::size_t worst = 0;                      ///< index of the largest volume; one that keeps wearing is worse than any
  Eigen::VectorXd envelope;                   ///< [Nc] m, largest depth of each node over the band
  WearAnswer answer;                          ///< of the worst frequency
  int solves = 0, failed = 0;
};

/// `--band-points` frequencies from `--band-from` to `--band-to`, each from the unworn joint.
[[nodiscard]] WearBand wear_band(const WearOptions& options, const LoadedModel& loaded, const wear::Watcher& watcher);

}  // namespace dovetail::studies
