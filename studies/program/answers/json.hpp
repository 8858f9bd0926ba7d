#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "optimizer/problem/evaluation.hpp"
#include "optimizer/problem/problem.hpp"
#include "steady/options.hpp"
#include "studies/program/engine/wear_quality.hpp"
#include "wear/asymptote/spread.hpp"

namespace dovetail::studies {

/// JSON texts of the commands, ending with a newline; SI but for `parameters`, which are in the units their keys name.
/// Doubles are written with the shortest text that reads back to the same value. A number that does not exist is null:
/// of an evaluation, a response that is not finite; of a wear computation, the number of cycles of an asymptote.

/// {"status", "feasible", "parameters", "responses", "constraints", "error_estimates", "error_sources", "unbounded",
/// "undecided_constraints", "model", "timings_s", "messages"[, "derivatives"][, "cases"][, "mission"]
/// [, "objective":[{"response"[, "over"], "value", "error_estimate"}]][, "accuracy"]}: what the terms of the problem's
/// objective come to over all cases, in the unit of the response; the last one, see accuracy_json, where settings were
/// chosen.
[[nodiscard]] std::string evaluation_json(const optimizer::Evaluation& evaluation,
                                          const nlohmann::ordered_json* accuracy = nullptr,
                                          const optimizer::Problem* problem = nullptr);

/// How a wear computation was asked for, and what was computed besides.
struct WearQuestion {
  double frequency_hz = 0;  ///< excitation, at the start
  Drive follow = Drive::fixed;
  steady::Options settings = {};
  struct Automatic {
    Status status;
    double accuracy;
  };
  std::optional<Automatic> automatic = {};  ///< of harmonics and samples, when asked for
  std::optional<WearBars> bars = {};        ///< when asked for
  std::optional<wear::Spread> spread = {};  ///< when asked for
  const WearBand* band = nullptr;           ///< when asked for
};

/// {"method", "status", "follow", "frequency_hz", "frequencies_hz":[S], "cycles":[S], "worn_volume_m3":[S],
/// "depth_m":[Nc], "final_wear_rate_m_per_cycle":[Nc], "solves", "settings":{"harmonics", "samples", "tolerance",
/// "solver"[, "automatic"]}[, "error_bars":{"worn_volume_m3", "largest_depth_m"}][, "spread"][, "band"]}.
/// What is not known where the status is not_converged is null, and "reason" says why.
/// A history adds "ended", "finished" (the last entry of every list [S] is then the direct method's state from the
/// history's end, which depth_m and the final rate are of; its number of cycles is null), "final_worn_volume_m3",
/// "amplitude_m":[S], "depths_m":[S][Nc], "wear_rates_m_per_cycle":[S][Nc], "history" (how it was computed, and what
/// --resume needs) and, when asked for, "response_curves". An asymptote has S = 1 and cycles [null] and adds
/// "certificate", "finer_certificate":{"harmonics", "samples", "status", "remaining",
/// "holds"}, "decided_by", "doubt", "confirmed_by_history" and "other_states"; its `frequencies_hz` are those of the
/// successive asymptotes when the resonance is followed.
[[nodiscard]] std::string wear_json(const WearQuestion& question, const WearAnswer& answer);

}  // namespace dovetail::studies
