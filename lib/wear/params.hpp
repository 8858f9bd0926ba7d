#pragma once

namespace dovetail::wear {

// The numbers that steer wear computations. They were tuned on half-plane punches, dovetail sections of 16 to 48 edges
// per flank and the labelled scenes of tests/verification/wear, and hold for none of them alone. What must hold between
// them is asserted below.

/// Which nodes a pass of release takes.
struct ReleaseParams {
  /// A node that touches at times only waits while another is faster by 1 / waits. Smaller: nodes that slip a little
  /// at touch-down are worn off although they come to rest with the others; larger: more passes.
  double waits = 0.02;
  /// The slow order releases nodes at least so fast as the fastest. 1: a pass per node; 0: the quick order again.
  double slow_share = 0.5;
};

/// When the direct answer is in doubt.
struct DoubtParams {
  /// Friction margin of a node that sticks below which a history may wear it, too. Punches whose histories took one
  /// node more ended with 0.015 to 0.03, others with 0.04 and above. Larger: histories for nothing.
  double near_slip = 0.05;
  /// Rate of a node that does not wear, on the way to the worn state and over the fastest one, that counts as slip.
  /// Below 7e-4 where histories end in the direct state, 0.06 to 0.66 where they took a node more (rough flanks, 1e13
  /// to 1e14 N/m^3).
  double slips = 0.01;
  /// Where on the way this is looked at, as parts of the depth.
  double early = 0.5, late = 0.75;
  /// Load of a sample, over the largest of its node, whose friction margin says nothing: a ratio of two small forces.
  double light_load = 1e-3;
};

/// How little may bear what only the contact holds. Load drawn together on a part f of a flank closes it by about
/// 1 + ln(1/f) times its compression; dovetails that come to rest end with 0.01 to 0.7 of it.
struct BearingParams {
  double few = 0.25;      ///< part of the bearing area below which, and
  double deep = 2.0;      ///< depth over compression above which only a history can confirm a state
  double too_deep = 5.0;  ///< the same above which there is no state, whoever finds it
  double nothing = 1e-9;  ///< stiffness, relative, that rounding leaves of a direction that nothing holds
};

/// What counts as no wear, see no_wear_rate.
struct NoWearParams {
  /// Of the elastic give of a node. Smaller: nodes that a spin-up left at their friction limit wear for ever by the
  /// noise of their samples; larger: slow wear is taken for none.
  double share = 4e-6;
  double worn = 0.02;  ///< of the largest depth: nodes worn by less show a trace of the way only
};

/// When rates have levelled out, so that wear goes on for ever: they stay within `change` of the largest one while the
/// joint wears by `depth` of its largest local penetration (largest_penetration), far beyond the depth over which its
/// pressures change. Smaller `depth`: slow histories are taken for endless.
struct LevelParams {
  double depth = 300.0;
  double change = 1e-3;
  /// Rates may rise by more, as where a joint that slips all over moves outwards and its centrifugal load grows with
  /// the radius: what rises does not come to rest.
  double rise = 0.05;
  double first = 0.05;   ///< of the depth: states before that are of the run-in
  double earlier = 0.5;  ///< of the depth, at which the rates were that they are compared with
};

/// How a history is finished by the direct method.
struct FinishParams {
  double below;         ///< rate, over the first one, from which on it is tried; 0: where the history is worn out only
  double close_before;  ///< largest change of depth by it, relative, while the history still wears: what the released
                        ///< nodes leave to others would still have to wear in time
  double close_at_end;  ///< the same when it is worn out
  bool follows_tail;    ///< where it is no way out the tail is followed until it leaves nothing
  double again = 0.1;   ///< rate over that of a failed try at which the next is made
  /// Rate times cycles, relative to the depth, that ends a tail, and the rate, over the one that counts as none, that
  /// ends any: slip far below it is noise of the samples.
  double nothing_left = 1e-4, silent = 0.1;
};
inline constexpr FinishParams kFinishExplicit{
    .below = 0.0, .close_before = 0.0, .close_at_end = 0.05, .follows_tail = false};
inline constexpr FinishParams kFinishImplicit{
    .below = 1e-2, .close_before = 3e-3, .close_at_end = 5e-3, .follows_tail = true};

/// What a finish may release and move, see finish_by_release.
struct FinishByReleaseParams {
  double still_wears = 1e-5;  ///< rate times cycles, over the largest depth, of a node that is released
  int passes = 10;            ///< of release
  /// Rates that die out like n^-p, p > 4/3, leave less than this many times rate times cycles.
  double tail = 3.0;
  double slack = 1e-3;  ///< depth that neighbours wear after them, relative to the largest
};

/// Cycle jumps by the rate at their start.
struct ExplicitParams {
  int halvings = 8;           ///< times a jump whose state does not converge is halved before giving up
  double safety = 0.9;        ///< of the jump that the error permits
  double shortest_cut = 0.1;  ///< least and
  double longest_cut = 0.8;   ///< largest factor of a jump that erred too much
  double slowest = 0.5;       ///< least and
  double fastest = 2.0;       ///< largest factor from one jump to the next
  double unresolved = 1e-3;   ///< of the increment: shorter jumps pass whatever their error, the rates jump there
};

/// Implicit steps.
struct ImplicitParams {
  double first_increment = 0.05;  ///< largest increase of depth in the first step, over the largest penetration
  double growth = 3.0;            ///< largest growth of the step from one to the next
  double shrinking = 0.3;         ///< least
  /// Residual of a stage, over the excitation, per unit of the local error that a step may have. Smaller: stages far
  /// more exact than their steps.
  double stage = 5e-4;
  double damping = 0.05;       ///< residual, relative, to which errors are damped as the equations do
  double least_pivot = 1e-6;   ///< of a node whose depth is eliminated from both equations, of 1
  int stage_iterations = 10;   ///< Jacobians per stage before a step is cut
  double chord_ratio = 0.4;    ///< contraction by old factors below which no new ones are taken
  double floors = 4.0;         ///< rounding floor of a stage over that of a state: its second equation adds one
  double safety = 0.9;         ///< of the step that the error permits
  double shortest_cut = 0.1;   ///< least and
  double longest_cut = 0.7;    ///< largest factor of a step that erred too much
  double unsolved_cut = 0.25;  ///< factor of a step whose equations could not be solved;
  int recovery = 3;            ///< the next ones grow slowly,
  double slow_growth = 1.5;    ///< by so much at most
  double smallest = 1e-5;      ///< shortest step, relative to the depth, before the branch counts as ended;
  double leap = 100.0;         ///< a jump to another branch is that many of them long,
  int jumps = 20;              ///< and so many of them make a history
};

/// Successive asymptotes at a moving resonance.
struct FollowParams {
  int asymptotes = 30;      ///< at most
  double tolerance = 1e-7;  ///< relative change of the frequency that ends them
};

/// Where between two nodes a worn zone ends.
struct EdgeParams {
  /// Weight of a node's excess of slip against its neighbour's margin. Next to an edge the margin grows like the square
  /// root of the distance and slip like its power 3/2, so that means over cells of equal length are not equally far
  /// from zero. With this weight, times the ratio of the lengths, an edge of dovetails with 24 to 48 edges per flank
  /// stays where it is (within 1 % of the worn volume) whatever the cells.
  double excess = 0.7;
};

/// When two worn states differ by no more than where within a node their zones end.
struct ApartParams {
  /// Of the larger worn volume. Where a node is more of it the nodes are too long to tell. Of designs whose histories
  /// end a node apart the direct volume stands on ever shorter nodes where the two differ by up to a fifth; farther
  /// apart it is the one or the other. Larger: a history that ends elsewhere is not heard; smaller: finer histories for
  /// nothing.
  double most = 0.2;
};

/// What the end of a slipping zone leaves open of its energy. Slip is largest near the end of a zone that lifts off,
/// and the zone may end anywhere between its last node and the middle of the next, which sticks. The energy between is
/// open by a part that grows with the node's share s of the zone's energy like s^2, as a finer mesh sees what happens
/// in a zone of several nodes. A zone that ends on both sides is open on both.
struct OpenEnergyParams {
  double part = 0.4;  ///< the one with which designs of studies/error_bars, seeds 2 and 3, had energies inside the bars
  double sticks = 0.01;  ///< of the energy per area of its neighbour: creep of nodes that all but stick
};

// What must hold between them, whatever their values.
static_assert(DoubtParams{}.early < DoubtParams{}.late && DoubtParams{}.late < 1, "looked at on the way, in order");
static_assert(DoubtParams{}.light_load < DoubtParams{}.near_slip, "what is ignored is less than what decides");
static_assert(BearingParams{}.deep < BearingParams{}.too_deep, "doubtful before impossible");
static_assert(LevelParams{}.change < LevelParams{}.rise, "falling is judged more strictly than rising");
static_assert(kFinishImplicit.close_before <= kFinishImplicit.close_at_end, "early finishes must be closer");
static_assert(FinishByReleaseParams{}.slack < kFinishImplicit.close_before, "the slack is part of what is close");
static_assert(FinishByReleaseParams{}.still_wears < kFinishImplicit.nothing_left,
              "a tail ends after its nodes are released");
static_assert(ExplicitParams{}.longest_cut < ExplicitParams{}.safety, "a step that failed comes back shorter");
static_assert(ImplicitParams{}.longest_cut < ImplicitParams{}.safety, "a step that failed comes back shorter");
static_assert(ImplicitParams{}.slow_growth < ImplicitParams{}.growth, "recovering steps grow more slowly");
static_assert(ImplicitParams{}.smallest * ImplicitParams{}.leap < ImplicitParams{}.first_increment,
              "a jump to another branch is no longer than a first step");

}  // namespace dovetail::wear
