#pragma once

#include <Eigen/Core>
#include <span>
#include <string_view>

#include "core/enum_names.hpp"
#include "core/options.hpp"
#include "core/status.hpp"
#include "paths/resonance.hpp"
#include "steady/state.hpp"
#include "wear/follow.hpp"
#include "wear/no_wear.hpp"
#include "wear/watcher.hpp"

namespace dovetail::wear {

/// What makes a step, see integrator.hpp.
enum class IntegratorKind {
  explicit_jumps,  ///< by the rate of the last state
  implicit_steps,  ///< large ones, of U and W together
};
constexpr EnumNames<IntegratorKind, 2> enum_names(IntegratorKind) {
  return {{{IntegratorKind::explicit_jumps, "explicit"}, {IntegratorKind::implicit_steps, "implicit"}}};
}
[[nodiscard]] constexpr std::string_view to_string(IntegratorKind kind) {
  return name_of(kind);
}

struct HistoryOptions {
  IntegratorKind integrator = IntegratorKind::explicit_jumps;
  // > 0. explicit: largest increase of depth per step, m (W_tot). The error of the worn state is first order in it.
  double increment = 1e-7;
  // in [0, 0.5]. Local error per step, relative to the largest depth worn so far or, while that is less, to the largest
  // local penetration of the first state (lambda_N over a node's own stiffness): a step that errs more is repeated
  // shorter. explicit: 1/2 dN |dW(next) - dW| of any node; 0: increments are what `increment` says.
  double tolerance = 0.0;
  // >= 1. Steps at most.
  int steps = 200;
  // >= 0. Cycles at most, 0: no limit; the last step is cut to end there exactly.
  double cycles = 0.0;
  // in [0, 1). Worn out when the largest rate fell below this fraction of the first one.
  double rate_fraction = 1e-4;
  // Worn out, too, when the largest rate fell below this, m per cycle; negative: from the model, see no_wear_rate.
  double rate_threshold = kFromModel;
  // Excite at the given frequency throughout, or (explicit) at the resonance of the joint as worn so far.
  Follow follow = Follow::fixed;
  // Finish a worn-out history at a fixed frequency by the direct method, so that no bias of the last rates remains:
  // implicit ones as soon as that moves hardly anything.
  bool finish = true;

  /// What suits implicit steps: 20 to 40 of them down to a millionth of the first rate.
  [[nodiscard]] static HistoryOptions implicit() {
    return {.integrator = IntegratorKind::implicit_steps, .tolerance = 2e-4, .steps = 300, .rate_fraction = 1e-6};
  }
};

/// Why a history ended.
enum class HistoryEnd {
  worn_out,     ///< rates died out
  steady_rate,  ///< rates levelled out under load: they go on for ever (steady_rate.hpp)
  cycles,       ///< as many as asked for
  steps,        ///< used up
  failed,       ///< no step could be solved however short
  interrupted,
};
constexpr EnumNames<HistoryEnd, 6> enum_names(HistoryEnd) {
  return {{{HistoryEnd::worn_out, "worn_out"},
           {HistoryEnd::steady_rate, "steady_rate"},
           {HistoryEnd::cycles, "cycles"},
           {HistoryEnd::steps, "steps"},
           {HistoryEnd::failed, "failed"},
           {HistoryEnd::interrupted, "interrupted"}}};
}
[[nodiscard]] constexpr std::string_view to_string(HistoryEnd end) {
  return name_of(end);
}

/// What a history carries from step to step besides its states: with it a resumed one goes on as if never stopped.
struct StepMemory {
  double step = 0;          ///< cycles of the next step (explicit: at most); 0: the integrator's own choice
  double penetration = 0;   ///< m, largest local one of the first state; 0: not known
  double no_wear = 0;       ///< m per cycle that count as none, of the first state; 0: not known
  double finish_below = 0;  ///< implicit: rate, over the first one, below which a finish is tried next; 0: its own
  int recovering = 0;       ///< implicit: steps that still grow slowly
  int jumps = 0;            ///< implicit: folds crossed
  Eigen::MatrixXd factored_displacement;  ///< implicit: U [nc, 2H+1] m where the Jacobian in use was taken, or empty
  Eigen::VectorXd factored_depth;         ///< implicit: W [Nc] m there,
  Eigen::VectorXd factored_cycles;        ///< and c [Nc] of its stage
};

/// Wear over cycles; entry 0 is the unworn state, S = accepted steps + 1.
struct History {
  Status status = Status::converged;  ///< converged unless a step could not be solved however short, or interrupted
  HistoryEnd end = HistoryEnd::steps;
  Eigen::VectorXd cycles;       ///< [S]
  Eigen::VectorXd worn_volume;  ///< [S] m^3
  Eigen::MatrixXd depth;        ///< [S, Nc] m
  Eigen::MatrixXd rate;         ///< [S, Nc] m per cycle, at that depth
  Eigen::VectorXd amplitude;    ///< [S] m, of the followed output; implicit: NaN but of the last state
  Eigen::VectorXd frequency;    ///< [S] exciting omega, rad/s
  /// Of the last accepted state, or of the final one when `finished`. Where an implicit history may go on it is as
  /// exact as its steps are.
  steady::State steady;
  Eigen::VectorXd final_depth;  ///< [Nc] m, of the direct method when `finished`, otherwise the last depth
  Eigen::VectorXd final_rate;   ///< [Nc] m per cycle, at that depth; empty when there is no state
  double final_volume = 0;      ///< m^3
  bool finished = false;        ///< by the direct method
  StepMemory memory;
  int solves = 0;     ///< steady states and implicit stages computed, failed ones included
  int jacobians = 0;  ///< factorised Jacobians over all of them
  int rejected = 0;   ///< steps that did not converge, or erred too much, and were shortened
};

/// Where a history begins.
struct HistoryStart {
  double omega = 0;                        ///< exciting frequency rad/s; with follow = resonance near the first one
  const steady::State* unworn = nullptr;   ///< the first steady state with its tangent, or null
  const History* past = nullptr;           ///< a history to go on with: its states come first in the result
  paths::ResonanceOptions resonance = {};  ///< the output whose amplitude is recorded and, when asked for, followed
};

/// Wear over cycles, dW/dn = r(U, W), f(U; W) = 0, from the depth that `joint` has (of `past`: from its last one) until
/// nothing wears any more, rates have levelled out, or steps or cycles are used up. A state that did not converge is
/// never built on.
///
/// Nodes released in `joint` never touch; an implicit history must release none. Cost: one steady state per explicit
/// step (or one resonance), two to five Jacobians per implicit one. Throws InputError for options out of range.
[[nodiscard]] History history(const steady::Joint& joint, const HistoryStart& start, const HistoryOptions& options = {},
                              const Watcher& watcher = {});

}  // namespace dovetail::wear

namespace dovetail {
template <>
std::span<const Field<wear::HistoryOptions>> option_table<wear::HistoryOptions>();
}
