#pragma once

#include <cmath>
#include <functional>
#include <vector>

#include "branches/branch.hpp"

namespace dovetail::branches {

/// How a branch of steady states is followed. One unit of arc length is a change of the contact's displacements, their
/// static part included, by the size of their vibration, so the steps adapt to a resonance of any width; see ArcMetric.
struct FollowOptions {
  double largest_parameter_step = 0.05;  ///< between points, fraction of the interval followed, (0, 1]
  /// Of outputs between points, relative, > 0. The contact may change by FollowParams::creep times that: its static
  /// part may creep while nothing else changes.
  double largest_change = 0.3;
  double largest_turn = 0.5;    ///< between the tangents of neighbouring points, rad, > 0
  double initial_step = 0.02;   ///< first step, arc length, > 0
  double smallest_step = 1e-8;  ///< arc length at which the branch is given up, > 0
  double smallest_turn = 1e-3;  ///< reversal of the parameter that counts, fraction of the interval, [0, 1]
  int max_corrections = 12;     ///< Jacobians per point tried, >= 2
  int max_points = 2000;        ///< >= 2
  int max_jacobians = 0;        ///< of everything, rejected steps included; 0: no limit
  bool locate_turns = true;     ///< put a point on every turning point of the parameter
};

/// Where a branch begins, where it leads, and the other end by which it may leave when it comes back: `from` and `to`
/// differ, `from` is not beyond `back`. An infinite `back` is no end.
struct Interval {
  double from = 0, to = 0, back = 0;

  [[nodiscard]] double sign() const { return to > from ? 1 : -1; }
  [[nodiscard]] double size() const { return std::abs(to - from); }
};

/// A point of a branch.
struct BranchPoint {
  steady::State state;    ///< converged; with its tangent when steady::Options::linearise
  double parameter = 0;   ///< at which it stands
  double arc_length = 0;  ///< along the branch from its start
  double direction = 1;   ///< change of the parameter with the arc length, in units in which the tangent has length 1;
                          ///< changes sign at a turn
  int turns = 0;          ///< turning points of the parameter passed so far; odd: the branch runs backwards
  bool is_turn = false;   ///< the extreme of the parameter at a turn that counts
};

struct Branch {
  /// converged: followed until it left the interval. Otherwise why it ended early: iteration_limit (max_points,
  /// max_jacobians), interrupted, or what the last correction said when the step became the smallest.
  Status status = Status::iteration_limit;
  std::vector<BranchPoint> points;     ///< in order; only the first can be unconverged, when the start failed
  int jacobians = 0, evaluations = 0;  ///< of everything, the start and rejected steps included
  int rejected = 0;                    ///< steps that were cut and tried again
  double penalty_ratio = 1;            ///< eps of the whole branch; that of the start
  [[nodiscard]] int turns() const { return points.empty() ? 0 : points.back().turns; }
};

/// Follows the branch of f(U, s) = 0 from the state `start` at interval.from by pseudo-arclength continuation, through
/// turning points of the parameter s, until it leaves the interval. The last point stands exactly at the end it left
/// by: interval.to, or interval.back when it came back. A converged start must have its tangent; one that is not
/// converged is handed back.
///
/// Predictor: the tangent t, J dU + df/ds ds = 0, oriented along the way come and by the sign of det J. Corrector:
/// Newton on (U, s) with f = 0 and t.(x - x_predicted) = 0 by one factorisation of J, two right-hand sides and
/// refinement against the bordered system, which is regular at a turning point where J is singular. The step follows
/// the number of corrections, the turn of the tangent and the change of the outputs; a step that fails is shortened.
///
/// Sampled in time, f is piecewise smooth: where a sample changes its contact state the branch has a kink, and near a
/// fold the pieces zigzag, turning back by amounts that fall with the number of samples. At a kink the plane across
/// the tangent may miss the piece behind it; then the tangent of that piece is tried, found beyond the kink, and the
/// chord of the last points. Where short steps do not get through, a longer one along the chord steps over the folds
/// there. A turn counts once the parameter has come back by `smallest_turn`, and by 2 / samples of the interval if
/// that is more: `turns` and `is_turn` of the points since the extreme are set then, after `progress` saw them.
///
/// `progress` may return false to stop. Throws InputError on bad options; all else is a status. Cost per point: about
/// 3 factorisations of J and as many problems set up.
[[nodiscard]] Branch follow(const Equations& equations, steady::State start, const Interval& interval,
                            const FollowOptions& options = {},
                            const std::function<bool(const BranchPoint&)>& progress = {});

}  // namespace dovetail::branches

namespace dovetail {
template <>
std::span<const Field<branches::FollowOptions>> option_table<branches::FollowOptions>();
}
