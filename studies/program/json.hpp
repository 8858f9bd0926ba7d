#pragma once

#include <string>
#include <vector>

#include "optimizer/evaluation.hpp"
#include "wear/asymptote.hpp"
#include "wear/history.hpp"

namespace dovetail::studies {

/// JSON texts of the commands, ending with a newline; SI but for `parameters`, which are in the units their keys name.
/// Doubles are written with the shortest text that reads back to the same value. A number that does not exist is null:
/// of an evaluation, a response that is not finite; of a wear computation, the number of cycles of an asymptote.

/// {"status", "feasible", "parameters", "responses", "constraints", "error_estimates", "model", "timings_s",
/// "messages"[, "derivatives"]}
[[nodiscard]] std::string evaluation_json(const optimizer::Evaluation& evaluation);

/// How a wear computation was asked for.
struct WearQuestion {
  double frequency_hz = 0;       ///< excitation, at the start
  std::string follow = "fixed";  ///< fixed, or tracking the resonance
};

/// {"method", "status", "follow", "frequency_hz", "frequencies_hz":[S], "ended", "cycles":[S], "worn_volume_m3":[S],
/// "depth_m":[Nc], "final_wear_rate_m_per_cycle":[Nc], "solves"}
[[nodiscard]] std::string history_json(const WearQuestion& question, const wear::History& history);

/// The same with S = 1 and cycles [null]; besides, the volume with the worn zone's edge between nodes and its bracket,
/// "interpolated_volume_m3" and "volume_bracket_m3":[2]. `frequencies_hz` are those of the successive asymptotes when
/// the resonance is followed.
[[nodiscard]] std::string asymptote_json(const WearQuestion& question, const wear::Asymptote& asymptote,
                                         const std::vector<double>& frequencies_hz, int solves);

/// "asymptote" | "no_asymptote" | "not_converged": a history that ended at the cycles asked for is "no_asymptote".
[[nodiscard]] std::string wear_status(const wear::History& history);

}  // namespace dovetail::studies
