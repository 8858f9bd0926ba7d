#pragma once

#include <Eigen/Core>
#include <memory>
#include <span>

#include "core/options.hpp"
#include "core/status.hpp"
#include "steady/steady_state.hpp"
#include "wear/control.hpp"
#include "wear/history.hpp"
#include "wear/no_wear.hpp"
#include "wear/steady_rate.hpp"

namespace dovetail::wear {

struct ImplicitHistoryOptions {
  // in (0, 0.5]. Local error per step, relative to the largest depth so far or, while that is less, to the largest
  // local penetration of the unworn contact (lambda_N over the node's own stiffness).
  double tolerance = 2e-4;
  // > 0. Largest increase of depth in the first step, relative to that penetration.
  double first_increment = 0.05;
  // > 1. Largest growth of the step from one to the next.
  double growth = 3.0;
  // >= 1. Steps at most, accepted and rejected.
  int steps = 300;
  // >= 0. Cycles at most, 0: no limit; the last step is cut to end there exactly.
  double cycles = 0.0;
  // >= 1. Jacobians per stage of a step before it is cut.
  int stage_iterations = 10;
  // in [0, 1). Worn out when the largest rate fell below this fraction of the first one.
  double rate_fraction = 1e-6;
  // Worn out, too, when the largest rate fell below this, m per cycle; negative: from the model, see no_wear_rate.
  double rate_threshold = kFromModel;
  // > 1. Rates of which none falls by more than `level_change` while the depth doubles, beyond this many of those
  // penetrations, have levelled out: wear goes on for ever.
  double level_depth = kLevelDepth;
  // in (0, 1).
  double level_change = kLevelChange;
  // Finish a worn-out history by releasing the nodes that still wear, so that no bias of the last rates remains.
  bool finish = true;
  // >= 0. Cycles that `start` has behind it, when a history is resumed.
  double start_cycles = 0.0;
  // >= 0. Largest rate of its first state, m per cycle, which rate_fraction refers to; 0: that of `start`.
  double reference_rate = 0.0;
};

/// Wear over cycles in large steps; entry 0 is the unworn state, S = accepted steps + 1 (one more when finished).
struct ImplicitHistory {
  Status status = Status::converged;
  HistoryEnd end = HistoryEnd::steps;
  Eigen::VectorXd cycles;       ///< [S]; infinite for the finished state
  Eigen::VectorXd worn_volume;  ///< [S] m^3
  Eigen::MatrixXd depth;        ///< [S, Nc] m
  Eigen::MatrixXd rate;         ///< [S, Nc] m per cycle
  steady::State steady;         ///< of the last state
  bool finished = false;        ///< the last state is that of the direct method
  StepMemory memory;
  double finish_change = 0.0;        ///< largest change of depth by finishing, m
  double largest_penetration = 0.0;  ///< of the unworn contact, m
  int jumps = 0;                     ///< short explicit steps across folds, where the branch followed ends
  int rejected = 0;                  ///< steps cut because they failed or erred too much
  int solves = 0;                    ///< steady states and stages solved, failed ones included
  int jacobians = 0;                 ///< factorised Jacobians over all of them
  int evaluations = 0;               ///< residuals
};

/// Wear history with (U, W) integrated together, dW/dn = r(U, W), f(U; W) = 0, by a stiffly accurate, L-stable scheme
/// of second order: stages W_s = B_s + c r(U_s, W_s) are solved by Newton's method on (U, W) at once with U eliminated
/// by the factorised Jacobian, one factorisation per iteration,
///   dU = -J^-1 (f + J_W dW), (I - c R) dW = -(g - c r_U J^-1 f), g = W - B - c r, R = dr/dW along f = 0,
/// over the nodes that wear. Steps grow while the local error permits and end where nothing wears any more; a step
/// that does not converge is cut and never built on. Where none converges however short, as at a fold, one explicit
/// step goes to the state that the joint has there. No node loses depth, and none is worn past the load that wears it.
///
/// @param omega   excitation frequency rad/s, held
/// @param joint   with the wear depth to start from; it must release no node
/// @param unworn  steady state of `joint` at omega with its tangent to begin with, or null
/// @param past    a history to go on with, or null: the condition of `joint`, start_cycles and reference_rate are then
/// those of resume().
///                Its states come first in the result and `steady.displacement`, if any, starts the first solve
/// Cost: two to five Jacobians per step, 20 to 40 steps. Throws InputError for options out of range and for nodes
/// released at the start.
[[nodiscard]] ImplicitHistory implicit_history(const steady::Joint& joint, double omega,
                                               const ImplicitHistoryOptions& options = {},
                                               const steady::State* unworn = nullptr, const Control& control = {},
                                               const History* past = nullptr);

/// The same as a history like the explicit ones: a finish at the end becomes its final depth, and the amplitude is
/// known of the last state only.
[[nodiscard]] History as_history(const ImplicitHistory& implicit, const dynamics::CondensedModel& model);

}  // namespace dovetail::wear

namespace dovetail {
template <>
std::span<const Field<wear::ImplicitHistoryOptions>> option_table<wear::ImplicitHistoryOptions>();
}
