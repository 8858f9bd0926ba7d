#pragma once

#include <Eigen/Core>
#include <functional>
#include <span>
#include <string_view>
#include <vector>

#include "core/budget.hpp"
#include "core/enum_names.hpp"
#include "core/options.hpp"
#include "core/status.hpp"
#include "steady/state.hpp"
#include "wear/asymptote/certificate.hpp"
#include "wear/asymptote/doubt.hpp"
#include "wear/asymptote/gross_sliding.hpp"
#include "wear/no_wear.hpp"
#include "wear/release/zone_edges.hpp"
#include "wear/watcher.hpp"

namespace dovetail::wear {

/// What became of the wear after infinitely many cycles.
enum class Verdict {
  asymptote,      ///< wear stops: `depth` is the limiting worn geometry
  no_asymptote,   ///< wear goes on for ever at the rates in `rate`
  not_converged,  ///< not known; `status` says what failed
};
constexpr EnumNames<Verdict, 3> enum_names(Verdict) {
  return {{{Verdict::asymptote, "asymptote"},
           {Verdict::no_asymptote, "no_asymptote"},
           {Verdict::not_converged, "not_converged"}}};
}
[[nodiscard]] constexpr std::string_view to_string(Verdict verdict) {
  return name_of(verdict);
}

/// Whether the implicit history has the last word.
enum class Arbitration {
  automatic,  ///< where the direct answer is in doubt
  unsettled,  ///< only where release did not come to a certified end or the wear law lets nodes rest in slip
  never,      ///< then "no asymptote" is not confirmed either
  always,
};
constexpr EnumNames<Arbitration, 4> enum_names(Arbitration) {
  return {{{Arbitration::automatic, "auto"},
           {Arbitration::unsettled, "unsettled"},
           {Arbitration::never, "never"},
           {Arbitration::always, "always"}}};
}
[[nodiscard]] constexpr std::string_view to_string(Arbitration arbitration) {
  return name_of(arbitration);
}

struct AsymptoteOptions {
  // Wear per cycle below which a loaded node counts as stuck, m per cycle; negative: from the model, see no_wear_rate.
  double rate_threshold = kFromModel;
  // in [0, 1). The same, relative to the largest rate of the unworn state: slip below about 1e-5 of genuine slip (at
  // 128 samples, more where nodes lift off) does not converge with harmonics and samples but is noise of the time
  // discretisation.
  double relative_threshold = 1e-4;
  // >= 0. Largest rate that certificate and relative_threshold refer to, m per cycle; 0: that of the start.
  double reference_rate = 0.0;
  // >= 1. Passes of release; each releases every loaded node that slips.
  int passes = 60;
  Arbitration arbitration = Arbitration::automatic;
  // > 0. Two worn states are the same when their depths differ by less than this, relative to the largest depth.
  double state_tolerance = 1e-2;
  // in (0, 0.5]. Local error per step of the implicit history, relative to the largest depth. Below
  // state_tolerance, or the history cannot tell whether it ends in the direct state. Smaller ones cost steps and buy
  // little: its end is finished by the direct method.
  double history_tolerance = 2e-3;
  // Solve once more with the worn gap and contact everywhere, and report the remaining rate.
  bool certify = true;
  // in (0, 1]. With a remaining rate above this fraction of the unworn one (and above rate_threshold), or when that
  // state cannot be solved, the verdict is not_converged.
  double certificate_limit = 1e-2;
  // Check the certificate at 2H+1 harmonics and 2N samples, too. Above its limit there the worn state rests at these
  // settings only: `doubt` says so.
  bool certify_finer = true;
  // A budget of its own, at the settings given, for what tells of doubt and the history; empty: that of the joint.
  std::function<SharedBudget(const steady::Options&)> history_budget = {};
};

/// Another state in which nothing wears.
struct OtherState {
  FoundBy found_by = FoundBy::release;
  Eigen::VectorXd depth;       ///< [Nc] m
  double worn_volume = 0.0;    ///< m^3
  double largest_depth = 0.0;  ///< m
};
[[nodiscard]] OtherState other_state(FoundBy found_by, const reduction::ContactNodes& contact,
                                     const Eigen::VectorXd& depth);

/// The worn geometry at which wear stops.
struct Asymptote {
  Verdict verdict = Verdict::not_converged;
  Status status = Status::converged;  ///< of the last steady state asked for
  Eigen::VectorXd depth;              ///< [Nc] W, m; of the history if that decided
  std::vector<bool> released;         ///< [Nc] worn off: carries nothing any more (followed: at some time)
  ReleaseTrail trail;                 ///< of the passes of release (followed: of all asymptotes)
  double worn_volume = 0.0;           ///< m^3
  double largest_depth = 0.0;         ///< m
  Eigen::VectorXd unworn_rate;        ///< [Nc] dW of the unworn state, m per cycle
  Eigen::VectorXd rate;               ///< [Nc] dW of the worn state, m per cycle (no asymptote: the steady one)
  /// Largest rate with gap g + W and contact everywhere over the largest unworn rate; NaN when not computed.
  double certificate = 0.0;
  /// The same at 2H+1 harmonics and 2N samples, of the depth that is the answer; `harmonics` 0 when not asked for.
  Certificate finer;
  bool holds_finer = false;  ///< `finer` is within certificate_limit
  /// Of the answer. Where it is doubtful and no history confirms it, or impossible, the verdict is not_converged and
  /// the status gross_sliding, whatever `arbitration` says.
  Bearing bearing;
  Doubt doubt = Doubt::none;              ///< of the direct answer
  FoundBy decided_by = FoundBy::release;  ///< release | history: what `depth` and `verdict` are from
  bool confirmed_by_history = false;      ///< the history was run to an end and has decided
  Status history = Status::converged;     ///< of the history, where one was asked and came to no end
  std::vector<OtherState> other_states;   ///< states at rest where the history does not go
  steady::State unworn;                   ///< steady state before wear
  steady::State steady;                   ///< at the limit (no asymptote: the last one computed)
  int passes = 0;                         ///< of release
  int solves = 0;                         ///< steady states computed
  int jacobians = 0;                      ///< factorised Jacobians over all of them
};

/// Limiting worn geometry without the history: solve with the released nodes free of contact, release every loaded
/// node that slips, repeat until none does; then the released nodes have worn until they just do not touch,
/// W = max(0, max_t u_N - g). With the worn gap every node has zero rate: it sticks or carries nothing. Zero-rate
/// states are not unique: where pressures shift while the joint wears, or nodes lift off, a history can end deeper.
/// Where the direct answer is in `doubt` the implicit history decides; if it ends elsewhere, `depth` is the history's
/// and other_states holds the direct one. A verdict without asymptote is confirmed by it too. Should the history fail,
/// a certified direct answer stands with confirmed_by_history = false.
/// - `omega`: excitation frequency rad/s, held; the unworn resonance is a good choice
/// - `joint`: with the wear depth already there (the result includes it); it must release no node
/// - `unworn`: steady state of `joint` at omega to begin with, or null
///
/// Cost: 5 to 15 steady states, warm-started; a history 50 to 200 Jacobians more. Throws InputError for options out of
/// range and for nodes released at the start.
[[nodiscard]] Asymptote asymptote(const steady::Joint& joint, double omega, const AsymptoteOptions& options = {},
                                  const steady::State* unworn = nullptr, const Watcher& watcher = {});

/// Whether an answer that rests does so at 2H+1 harmonics and 2N samples, too: its `finer`, `holds_finer` and, where it
/// does not, its doubt. `joint` and `options` as asked for the answer. Cost: one steady state.
void certify_finer(const steady::Joint& joint, const AsymptoteOptions& options, Asymptote& answer);

}  // namespace dovetail::wear

namespace dovetail {
template <>
std::span<const Field<wear::AsymptoteOptions>> option_table<wear::AsymptoteOptions>();
}
