#pragma once

#include "branches/follow.hpp"
#include "steady/state.hpp"

namespace dovetail::paths {

// The numbers that steer searches for peaks and ways to a solution. They were tuned on the random small joints of
// tests/hard_cases, on rods with a friction damper and on dovetail sections; none follows from theory unless it says
// so.

/// How far along a branch a peak is resolved.
struct WidthParams {
  double sharpest =
      1e-6;             ///< half width over frequency: a sharper peak the frequency tolerance does not resolve either
  double widest = 0.5;  ///< where hardly anything vibrates
};

/// Where the slope of the amplitude vanishes, by secants within a bracket (Stationarity).
struct StationarityParams {
  /// Difference of the amplitudes at the ends of a bracket, relative, above which the curve jumps between them: a
  /// smooth peak differs by the square of the bracket over its width, far less when it is closed in on.
  double continuous = 1e-4;
  /// How far a step to a jump of the slope goes beyond it, over its length: the bracket shrinks by so much where the
  /// jump is as foreseen. 0: one end stays for ever.
  double beyond = 0.05;
  double part = 0.2;  ///< of the tolerance, which the last step may take
  /// Length, over the tolerance, of a step that looks for the other side of a jump of the slope, and how much longer
  /// the next is when it was none: below 1 the bracket that it makes is narrow enough.
  double probe = 0.9, farther = 3;
};

/// Newton's method on (U, s) for a peak. Lengths are in the metric of the branch: 1 is a change of the vibration by its
/// own size.
struct PeakParams {
  /// Distance from the branch within which Newton acts on the point and on its place at once; from further away the
  /// point is first brought back by the corrector with its line search.
  double near = 0.2;
  double short_step = 0.1;  ///< steps along the branch that are made without the corrector
  double trust = 0.25;      ///< the longest step; longer ones pass narrow peaks
  double clean = 0.1;       ///< distance from the branch, over the slope, within which a slope says where to go
  double away = 2;          ///< correction beyond which the point belongs to another branch
  int corrections = 8;      ///< Jacobians of one
  double turned = 0.2;      ///< cosine between branch and reference below which a search is begun anew
  int shortenings = 4;      ///< of a step whose end is not found,
  double shortening = 0.3;  ///< by this factor
  /// Second derivative of ln A with the arc length at the peak of a linear system: of theory, -1 over the width squared
  /// in frequency, along which the vibration changes as fast.
  double linear = -0.5;
  double flat = 5e-4;  ///< how well the place on the branch is known, even where the frequency hardly moves
};

/// Steps in frequency towards a peak.
struct ClosingInParams {
  double longest = 0.05;        ///< step over frequency: longer ones reach the peaks of other modes
  double near = 0.5;            ///< step over half width from which on slopes are bracketed,
  double trust = 4;             ///< and the longest step from then on, in half widths
  int hard = 12;                ///< Jacobians: a step within one branch takes fewer
  int cautious = 3, tries = 5;  ///< halvings of a step by Newton's method alone, and with all rescues
  int off_pole = 4;  ///< tries beside a start at an undamped pole of the glued joint, by turns on both sides,
  double off_pole_step = 1e-6;  ///< the first so far away, over frequency, each ten times as far as the one before
  int many_harmonics = 7;       ///< from so many on half of them find the way: a Jacobian costs their cube
  /// Where a peak found at another pseudo-penalty is looked for again, over frequency: the half width of one with
  /// little damping; and the amplitude, over the first one's, that it must have.
  double beside = 1e-3, no_lower = 0.999;
};

/// Newton on (U, omega) towards a maximum near by.
struct ClimbParams {
  double height = 0.99;  ///< of where it began: a search that ends lower has run off to another maximum
  int climbs = 8;        ///< where the branch turns away from where it led, the climb begins anew
  double gain = 1e-3;    ///< as long as it gains so much
};

/// Peaks of a coarse sweep.
struct PeakSweepParams {
  /// What counts is that no peak is stepped over, and the change of the outputs sees to that.
  branches::FollowOptions steps{.largest_parameter_step = 0.01,
                                .largest_change = 0.5,
                                .largest_turn = 0.8,
                                .max_points = 1000,
                                .locate_turns = false};
  std::size_t tried =
      6;  ///< summits that are climbed: one of coarse steps may be lower than the peak beside it is high
  double hopeless = 0.8;  ///< of the highest peak found: lower summits are not climbed
};

/// Following a peak over a parameter.
struct BackboneParams {
  std::size_t supports = 3;  ///< points of the predictor: more make it swing where the peak jumps
  double same = 1e-6;        ///< difference of height within which two searches have ended on one maximum
  double elsewhere = 0.5;    ///< change of frequency beyond which the peak is another one
  double moved = 0.05;       ///< change of frequency by the check after which it is made once more
  int rounds = 3;            ///< of it at most
  double far = 2;            ///< how far out it looks where there is no peak to be held against, over its range
  double narrower = 0.1, wider = 10;  ///< change of the width from one point to the next
};

/// Sweeps in frequency.
struct SweepParams {
  int halvings = 6;  ///< of the way to the next frequency before the branch counts as ended there
  /// How far behind a turning point another branch is looked for, over frequency.
  double further[3] = {0.01, 0.03, 0.1};
};

/// Fallbacks; tests/hard_cases prints what each earns, and what is lost without it.
struct WayParams {
  steady::Way left_out = steady::Way::none;  ///< not tried
  // Shares of the Jacobians that the ways before have left; the last takes the rest.
  double harmonics = 0.08, damping = 0.4, softer_damping = 1;
  double softer = 0.1;                    ///< eps of softer_damping
  double strongest = 10, weakest = 1e-5;  ///< dashpots, in units of eps: below the weakest there are none
  int weaker = 2;                         ///< tries below the strongest,
  double weaker_by = 0.1;                 ///< each by this factor
  /// Steps in which they fade, relative: one that fails is cut, one that succeeds lets the next grow, and when it has
  /// become too short the curve is followed.
  double longest = 0.6, shortest = 1e-2, growth = 1.3, cut = 2.5;
  /// Along the curve of fading dashpots only the end counts. With shorter steps the many kinks of hard cases cost more
  /// Jacobians than there are, with longer ones they are lost.
  branches::FollowOptions curve{
      .largest_parameter_step = 0.5, .largest_change = 2, .largest_turn = 1.5, .locate_turns = false};
};

// What must hold between them, whatever their values.
static_assert(PeakParams{}.short_step <= PeakParams{}.trust && PeakParams{}.trust < PeakParams{}.away,
              "short steps are within the longest, which stays on the branch");
static_assert(PeakParams{}.near < PeakParams{}.away, "a point that Newton takes as it is belongs to the branch");
static_assert(StationarityParams{}.part < StationarityParams{}.probe && StationarityParams{}.probe < 1,
              "the last step is within the tolerance, and so is the bracket that a longer one makes");
static_assert(StationarityParams{}.beyond > 0 && StationarityParams{}.beyond < 0.5,
              "a step beyond a jump brings more than a bisection");
static_assert(ClosingInParams{}.cautious < ClosingInParams{}.tries, "more tries where rescues help");
static_assert(PeakSweepParams{}.hopeless < ClimbParams{}.height, "what is climbed may be lower than its summit");
static_assert(BackboneParams{}.moved < BackboneParams{}.elsewhere, "moved before it is another peak");
static_assert(WidthParams{}.sharpest < ClosingInParams{}.beside, "beside a peak is outside the sharpest");
static_assert(WayParams{}.shortest < WayParams{}.longest, "steps may be cut");
static_assert(WayParams{}.weakest < WayParams{}.strongest, "dashpots fade");

}  // namespace dovetail::paths
