#pragma once

#include <optional>
#include <string>
#include <vector>

#include "optimizer/evaluation.hpp"
#include "response/options.hpp"
#include "wear/asymptote.hpp"
#include "wear/history.hpp"

namespace dovetail::studies {

/// JSON texts of the commands, ending with a newline; SI but for `parameters`, which are in the units their keys name.
/// Doubles are written with the shortest text that reads back to the same value. A number that does not exist is null:
/// of an evaluation, a response that is not finite; of a wear computation, the number of cycles of an asymptote.

/// {"status", "feasible", "parameters", "responses", "constraints", "error_estimates", "model", "timings_s",
/// "messages"[, "derivatives"]}
[[nodiscard]] std::string evaluation_json(const optimizer::Evaluation& evaluation);

/// How far harmonics, samples and pseudo-penalty may have moved a worn state; infinite: unknown.
struct WearBars {
  double worn_volume = 0;    ///< m^3
  double largest_depth = 0;  ///< m
};

/// How a wear computation was asked for.
struct WearQuestion {
  double frequency_hz = 0;       ///< excitation, at the start
  std::string follow = "fixed";  ///< fixed, or tracking the resonance
  response::SteadyOptions settings = {};
  struct Automatic {
    Status status;
    double accuracy;
  };
  std::optional<Automatic> automatic = {};  ///< of harmonics and samples, when asked for
  std::optional<WearBars> bars = {};        ///< when asked for
};

/// {"method", "status", "follow", "frequency_hz", "frequencies_hz":[S], "ended", "cycles":[S], "worn_volume_m3":[S],
/// "depth_m":[Nc], "final_wear_rate_m_per_cycle":[Nc], "solves", "settings":{"harmonics", "samples", "tolerance",
/// "solver"
/// [,"automatic"]}[, "error_bars":{"worn_volume_m3", "largest_depth_m"}]}
[[nodiscard]] std::string history_json(const WearQuestion& question, const wear::History& history);

/// The same with S = 1 and cycles [null]; besides, the volume with the worn zone's edge between nodes and its bracket,
/// "interpolated_volume_m3" and "volume_bracket_m3":[2]. `frequencies_hz` are those of the successive asymptotes when
/// the resonance is followed.
[[nodiscard]] std::string asymptote_json(const WearQuestion& question, const wear::Asymptote& asymptote,
                                         const std::vector<double>& frequencies_hz, int solves);

/// "asymptote" | "no_asymptote" | "not_converged": a history that ended at the cycles asked for is "no_asymptote".
[[nodiscard]] std::string wear_status(const wear::History& history);

}  // namespace dovetail::studies
