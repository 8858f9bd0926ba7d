#pragma once

namespace dovetail::branches {

// The numbers that steer how a branch is followed; FollowOptions are what callers choose. They were tuned on gap and
// friction oscillators with known folds and on the dashpot branches of tests/hard_cases.

/// Lengths, see ArcMetric.
struct MetricParams {
  /// Vibration of the contact, over that of its forces, below which forces say how large the vibration is: contact that
  /// is almost stuck hardly moves.
  double slip = 0.1;
  /// Vibration of contact or outputs, over the largest met, below which changes count against this floor: slip that is
  /// small, or an antiresonance, is no reason for tiny steps.
  double floor = 1e-2;
  double static_part = 1e-6;  ///< of the static forces that count as vibration where there is none
};

/// The bordered system: errors in it over the size of the terms that cancel.
struct BorderedParams {
  double exact = 1e-10;  ///< at which refinement ends
  double usable = 1e-4;  ///< worse after the last refinement: the whole matrix is factorised
  int refinements = 4;
  double regular = 1e-14;  ///< reciprocal condition below which two branches cross: no one row makes it regular
};

/// Newton's method in a plane across the branch.
struct CorrectorParams {
  /// Of the tolerance: Newton measures forces by the excitation at the start, which a pole of the glued structure may
  /// have changed.
  double slack = 2;
  double sidestep = 2;  ///< way to the point found over the step asked for, beyond which it is on another branch,
  double kink = 0.1;    ///< unless it is nearer than this part of the largest change: the way on behind a sharp kink
  /// Cosine between tangents above which a branch goes on straight through a crossing, whatever det J says.
  double straight = 0.9;
};

/// The follower.
struct FollowParams {
  /// A kink turns the tangent by the same angle however short the step: one shorter than this, in parts of the largest
  /// change, is taken as it is.
  double short_step = 0.03;
  /// Another piece of a fold beside the one followed is further away than this part of a short step, a branch that
  /// crosses is not.
  double crossing = 1e-2;
  double place = 0.1;                 ///< how far apart remembered places are, in parts of the largest change,
  std::size_t places = 16;            ///< and how many of them say where the branch goes on the whole
  int zigzag = 24;                    ///< points without a new place before a leap is tried
  double leaps[3] = {0.1, 0.3, 1.0};  ///< its lengths, in parts of the largest change
  double creep = 30;                  ///< largest change of the contact in one step, in parts of the largest change
  double onwards = 0.5;               ///< least cosine between a leap and where the branch went
  double bent = 0.95;      ///< cosine of tangents, and of chord and tangent, below which the other direction is tried
  double memory = 0.6;     ///< of the chord, from point to point
  double tolerated = 1.5;  ///< a step too long by this factor is not worth a second one
  double safety = 0.8;     ///< of the longest step that turns and changes permit
  double wanted_corrections = 4, growth = 2;     ///< Jacobians per point, and the factor per pair of them at most
  double failed_cut = 0.4;                       ///< of a step that was lost
  double shortest_cut = 0.2, longest_cut = 0.7;  ///< of one that turned or changed too much
  int turn_tries = 10;                           ///< points tried on the way to a turn
  double turn_flat = 1e-6;    ///< what the parameter can still change by there, in the units of the metric
  double turn_margin = 0.02;  ///< of the bracket: regula falsi stays away from its ends
};

// What must hold between them, whatever their values.
static_assert(BorderedParams{}.exact < BorderedParams{}.usable, "refinement aims at more than it needs");
static_assert(FollowParams{}.short_step < FollowParams{}.place, "a short step reaches no new place");
static_assert(FollowParams{}.longest_cut < FollowParams{}.safety, "a step that changed too much comes back shorter");
static_assert(FollowParams{}.safety * FollowParams{}.tolerated >= 1, "a tolerated step need not shrink twice");
static_assert(FollowParams{}.creep >= 1, "the contact may change at least as much as outputs");
static_assert(CorrectorParams{}.straight < FollowParams{}.bent, "straight on is not bent at once");

}  // namespace dovetail::branches
