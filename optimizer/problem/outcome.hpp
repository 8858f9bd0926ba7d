#pragma once

#include <string>
#include <string_view>

#include "core/enum_names.hpp"
#include "core/status.hpp"

namespace dovetail::optimizer {

/// How the computation of a candidate, or of a closer look at one, ended. Its status in files and messages is a text:
/// the name of the outcome, perhaps with words after a colon, or of a failure the stage and why:
/// "preload: iteration_limit".
enum class Outcome {
  converged,
  infeasible,   ///< a geometric rule is broken, no physics computed
  disagrees,    ///< of a verification: its answers lie further apart than their bars; the numbers follow
  interrupted,  ///< from outside
  failed,
};
constexpr EnumNames<Outcome, 5> enum_names(Outcome) {
  return {{{Outcome::converged, "converged"},
           {Outcome::infeasible, "infeasible"},
           {Outcome::disagrees, "disagrees"},
           {Outcome::interrupted, "interrupted"},
           {Outcome::failed, "failed"}}};
}
[[nodiscard]] constexpr std::string_view to_string(Outcome outcome) {
  return name_of(outcome);
}

/// That of a status.
[[nodiscard]] constexpr Outcome outcome_of(std::string_view status) {
  return named<Outcome>(status.substr(0, status.find(':'))).value_or(Outcome::failed);
}
[[nodiscard]] constexpr bool converged(std::string_view status) {
  return outcome_of(status) == Outcome::converged;
}

/// The status of an outcome that needs no more words.
[[nodiscard]] inline std::string status_of(Outcome outcome) {
  return std::string(to_string(outcome));
}

/// The status of a failure.
[[nodiscard]] inline std::string failed_at(std::string_view stage, std::string_view why) {
  return std::string(stage) + ": " + std::string(why);
}
[[nodiscard]] inline std::string failed_at(std::string_view stage, Status why) {
  return failed_at(stage, to_string(why));
}

/// The stage of what is no failure of a design: the process that computed it ended, or gave no answer in time.
inline constexpr std::string_view kWorkerStage = "worker";

/// Whether a status, perhaps that of a case, is such a one: the same computed again may have an answer.
[[nodiscard]] inline bool lost_with_its_process(std::string_view status) {
  const std::string stage = std::string(kWorkerStage) + ": ";
  return status.starts_with(stage) || status.find(": " + stage) != status.npos;
}

}  // namespace dovetail::optimizer
