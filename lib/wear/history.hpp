#pragma once

#include <Eigen/Core>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "core/options.hpp"
#include "core/status.hpp"
#include "paths/resonance.hpp"
#include "steady/steady_state.hpp"
#include "wear/control.hpp"
#include "wear/no_wear.hpp"

namespace dovetail::wear {

struct HistoryOptions {
  // > 0. Largest increase of depth per step, m (W_tot). The error of the worn state is first order in it.
  double increment = 1e-7;
  // in [0, 0.5]. Local error per step, 1/2 dN |dW(next) - dW| in any node relative to the largest depth worn so far or,
  // while that is less, to the largest local penetration of the first state: a step that errs more is repeated shorter.
  // 0: increments are what `increment` says.
  double tolerance = 0.0;
  // >= 1. Steps at most.
  int steps = 200;
  // >= 0. Cycles at most, 0: no limit; the last step is cut to end there exactly.
  double cycles = 0.0;
  // in [0, 1). Worn out when the largest rate fell below this fraction of the first one.
  double rate_fraction = 1e-4;
  // Worn out, too, when the largest rate fell below this, m per cycle; negative: from the model, see no_wear_rate.
  double rate_threshold = kFromModel;
  // in [0, 30]. Times a step whose steady state does not converge is halved before giving up.
  int halvings = 8;
  // Start each step from U + dU, dU = -J^-1 J_W dW with the last factorisation [Salles 2009, eq. 33-35].
  bool predictor = true;
  // fixed | resonance: excite at the given frequency throughout, or at the resonance of the joint as worn so far.
  std::string follow = "fixed";
  // Start each march from the slip left by the state before instead of the one given: stuck nodes then keep the
  // tractions of their own past. Off: every state is reached from the same preload, as the asymptote is.
  bool carry_slip = false;
  // Finish a worn-out history at a fixed frequency by the direct method: `final_depth` then has no bias of the last
  // rates.
  bool finish = true;
  // >= 0. Cycles that `start` has behind it, when a history is resumed.
  double start_cycles = 0.0;
  // >= 0. Largest rate of its first state, m per cycle, which rate_fraction refers to; 0: that of `start`.
  double reference_rate = 0.0;
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
[[nodiscard]] std::string_view to_string(HistoryEnd end);

/// What a history carries from step to step besides its states: with it a resumed one goes on as if never stopped.
struct StepMemory {
  double step = 0;          ///< cycles of the next step (explicit: at most); 0: the integrator's own choice
  double penetration = 0;   ///< m, largest local one of the first state; 0: not known
  double no_wear = 0;       ///< m per cycle that count as none, of the first state; 0: not known
  double finish_below = 0;  ///< implicit: rate, over the first one, below which a finish is tried next; 0: its own
  int recovering = 0;       ///< implicit: steps that still grow slowly
  int jumps = 0;            ///< implicit: folds crossed
  Eigen::MatrixXd factored_displacement;  ///< implicit: U [nc, 2H+1] m where the Jacobian in use was taken, or empty
  Eigen::VectorXd factored_depth;         ///< implicit: W [Nc] m there
};

/// Wear over cycles; entry 0 is the unworn state, S = accepted steps + 1.
struct History {
  Status status = Status::converged;  ///< converged unless a step could not be solved however short, or interrupted
  HistoryEnd end = HistoryEnd::steps;
  Eigen::VectorXd cycles;       ///< [S]
  Eigen::VectorXd worn_volume;  ///< [S] m^3
  Eigen::MatrixXd depth;        ///< [S, Nc] m
  Eigen::MatrixXd rate;         ///< [S, Nc] m per cycle, at that depth
  Eigen::VectorXd amplitude;    ///< [S] m, of the followed output at the exciting frequency
  Eigen::VectorXd frequency;    ///< [S] exciting omega, rad/s
  steady::State steady;         ///< of the last accepted state
  Eigen::VectorXd final_depth;  ///< [Nc] m, of the direct method when `finished`, otherwise the last depth
  Eigen::VectorXd final_rate;   ///< [Nc] m per cycle, at that depth; empty when there is no state
  double final_volume = 0;      ///< m^3
  bool finished = false;        ///< by the direct method
  StepMemory memory;
  int solves = 0;     ///< steady states computed, failed ones included
  int jacobians = 0;  ///< factorised Jacobians over all of them
  int rejected = 0;   ///< steps that did not converge, or erred too much, and were shortened
};

/// Called for every accepted state, the first included, e.g. to store a response curve of the joint as worn:
/// `condition` has its depth and slip origin.
using StateObserver =
    std::function<void(int step, double cycles, const steady::Condition& condition, const steady::State& state)>;

/// What continues a stored history: depth, slip and cycles of its last state.
struct Resumption {
  double omega = 0;  ///< rad/s
  steady::Joint joint;
  HistoryOptions options;
};
[[nodiscard]] Resumption resume(const History& stored, const steady::Joint& joint, const HistoryOptions& options);

/// Wear history by cycle jumps of constant largest increment: with the rate dW of the state at W, N += dN,
/// W += dN dW, dN = increment / max dW [Salles 2009, eq. 20-22]. A state that did not converge is never built on:
/// the step is halved from the last converged one. With `tolerance` steps are shortened to their local error besides.
///
/// @param omega      exciting frequency rad/s; with follow = resonance where the first search starts
/// @param joint      with the wear depth to start from; nodes released in it never touch
/// @param resonance  names the output whose amplitude is recorded and, when asked for, followed
/// @param past       a history to go on with, or null: the condition of `joint` and `options` are then those of
/// resume(). Its states
///                   come first in the result and `steady.displacement`, if any, starts the first solve
/// Cost: one steady state per step (or one resonance). Throws InputError for options out of range.
[[nodiscard]] History history(const steady::Joint& joint, double omega, const HistoryOptions& options = {},
                              const paths::ResonanceOptions& resonance = {}, const Control& control = {},
                              const StateObserver& observer = {}, const History* past = nullptr);

}  // namespace dovetail::wear

namespace dovetail {
template <>
std::span<const Field<wear::HistoryOptions>> option_table<wear::HistoryOptions>();
}
