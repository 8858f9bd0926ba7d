#pragma once

#include <array>

namespace dovetail::optimizer {

// The numbers that steer error bars, tuned on random designs against meshes four times as fine (studies/error_bars).
// Orders of convergence and what one response alone needs stand in its file in responses.

/// The companions that a design is compared with.
struct CompanionParams {
  /// Sizes of the elements of other meshes over a design's own, in the order in which they are asked.
  std::array<double, 2> finer{1 / 1.5, 1.5}, coarser{1.5, 2};
  double longer_nodes = 1.5;       ///< length of contact nodes over the design's own
  double shorter_nodes = 0.5;      ///< the same where nothing wears
  double shorter_factor = 2;       ///< part of what they change, as half of a zone may be missed on them, too
  double nodes_again = 0.25;       ///< part of what longer nodes change that remains beside a finer mesh
  double section_ratio = 1 / 1.5;  ///< sizes of elements in a finer section
  /// Layers along the slot of meshes that show what a finer section changes. Against eight of them, on two disks, of
  /// which one was not looked at before: the same in mass, pressure and tension, to 6 % in frequencies, to 15 % in the
  /// blade's fillet, as much or more in the disk's; energies and amplitudes change by 0.3 % at most on either. With two
  /// the energy did not change at all.
  int section_layers = 3;
  double harder = 2, softer = 0.5;  ///< pseudo-penalties, the softer one first
  double modes_factor = 1.5;        ///< of what twice as many modes change: the error falls like 1 / omega^2
  int more_modes = 10;              ///< at least: one more may be one that the load does not move
};

/// Zones narrower than half a contact node, of a joint that does not wear.
struct UnseenParams {
  /// Part of such a zone that slips. Of 90 joints without wear (seeds 2 and 3) finer meshes found a tenth of the energy
  /// of all of it in three, 0.4 and all of it in one each, where other parts of the bar were larger than it, and next
  /// to none in the others: none where no node at an end of a flank lifts off.
  double slipping = 0.3;
  double all_of_it = 0.25;  ///< change of the pressure in a period, relative, from which on all of the zone counts
};

/// How far off a history ends that decides, of its worn volume: by its tolerance, and by what its finish by the direct
/// method may move, whatever the tolerance. Of 20 designs of the quickstart with random flanks, forces and friction,
/// against histories to 5e-5: 0.5 % at most at a tolerance of 2e-3; of 12 of them 0.7 % at 5e-3, of 6 0.2 % at 2e-4. Of
/// 39 others, not looked at while these were chosen, all but one within it: there the two flanks, alike until then,
/// wear apart in the tail of the history, or do not, by its last digits (1.7 % of the volume, 3.7 % of the depth).
struct HistoryErrorParams {
  double finished = 3e-3, by_tolerance = 1.5;
};

/// What a history that ends in a state leaves open of it, of the node at each end of a zone, from histories on nodes a
/// quarter as long. Smaller: such a history ends outside of the bar.
struct HistoryNodeParams {
  double lift_off = 0.055;  ///< where some nodes touch at times only
  /// Where another order of release ends elsewhere, or nodes that stick have little to spare: a history depends on its
  /// nodes much more there.
  double others = 0.25;
};

/// Of the node at each end of a zone, what a resonance that is followed leaves open: the friction left beyond the end
/// hardly changes with where that is, and whether the zone grows with the resonance hangs on the length of its nodes.
/// 12 designs of the quickstart's box on 24 to 80 edges per flank, against 72 to 112 edges (which do not always
/// settle): about a fifth.
struct FollowedNodeParams {
  double part = 0.25;
};

static_assert(CompanionParams{}.shorter_nodes < 1 && 1 < CompanionParams{}.longer_nodes, "on both sides");
static_assert(CompanionParams{}.nodes_again < 1, "a finer mesh says most of it");
static_assert(CompanionParams{}.section_ratio < 1, "finer");
static_assert(HistoryNodeParams{}.lift_off < HistoryNodeParams{}.others, "the doubt of lift-off is the lesser one");

}  // namespace dovetail::optimizer
