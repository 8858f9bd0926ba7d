#include "optimizer/bars/worn_bars.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "optimizer/bars/params.hpp"
#include "optimizer/candidate/node_lines.hpp"
#include "paths/amplitude.hpp"
#include "wear/asymptote/drift.hpp"
#include "wear/asymptote/worn_zones.hpp"
#include "wear/measures.hpp"

namespace dovetail::optimizer {

namespace {

/// What a part of the node at the end of every zone changes.
wear::WornChange within_nodes(double part, const fem::ContactCells& cells, const wear::Asymptote& asymptote) {
  // Of a history that decided nodes may touch that it has worn: they carry what is left there.
  const std::vector<bool> worn =
      asymptote.decided_by == wear::FoundBy::history ? wear::worn_nodes(asymptote.depth) : asymptote.released;
  return wear::ends_moved_by(part, node_lines(cells), cells.area, worn, asymptote.depth);
}

/// Whole nodes are worn off or bear: where wear of a history comes to rest the end of a zone lies somewhere within a
/// node, and a history on shorter ones may end a part of it from there.
wear::WornChange within_nodes_of_history(const fem::ContactCells& cells, const wear::Asymptote& asymptote) {
  constexpr HistoryNodeParams kParams;
  return within_nodes(asymptote.doubt == wear::Doubt::lift_off ? kParams.lift_off : kParams.others, cells, asymptote);
}

/// The other state at rest that a history which came to an end leaves possible: its own, or that of the direct method
/// where the history decided. The direct method knows nothing of nodes that come to rest in slip.
const wear::OtherState* rival(const wear::Asymptote& asymptote) {
  if (!asymptote.confirmed_by_history || asymptote.doubt == wear::Doubt::threshold) return nullptr;
  const wear::FoundBy other =
      asymptote.decided_by == wear::FoundBy::history ? wear::FoundBy::release : wear::FoundBy::history;
  const auto found = std::ranges::find(asymptote.other_states, other, &wear::OtherState::found_by);
  return found == asymptote.other_states.end() ? nullptr : &*found;
}

/// What a doubt of the direct worn state leaves open: by how much a history that decided ends elsewhere; where it ends
/// in the same state, or nothing else was there to compare with, what its nodes leave open; and without a history that
/// ends it may be anything.
wear::WornChange left_in_doubt(const fem::ContactCells& cells, const wear::Asymptote& asymptote) {
  if (asymptote.doubt == wear::Doubt::none) return {};
  if (!asymptote.confirmed_by_history) return {.volume = asymptote.worn_volume, .depth = asymptote.largest_depth};
  if (const wear::OtherState* other = rival(asymptote))
    return {.volume = std::abs(other->worn_volume - asymptote.worn_volume),
            .depth = std::abs(other->largest_depth - asymptote.largest_depth)};
  return within_nodes_of_history(cells, asymptote);
}

/// What wear changes, it changes in proportion to the volume.
/// @param ends_alone  only the ends of worn zones are in doubt: on what those bear the amplitude hardly depends
LeftOpen worn_otherwise(const CandidateResult& result, const wear::WornChange& doubt, bool ends_alone) {
  const double volume = result.asymptote->worn_volume;
  const double share = volume > 0 ? doubt.volume / volume : 0;
  LeftOpen open{.worn_volume = doubt.volume, .worn_depth = doubt.depth};
  if (!result.worn) return open;
  open.drift = share * std::abs(drift(result));
  if (!ends_alone) open.worn_amplitude = share * std::abs(result.worn->amplitude - result.unworn->amplitude);
  return open;
}

/// What the tolerance of the unworn resonance, at which the joint wears, leaves open: off a peak the amplitude changes
/// by at most half of what the frequency changes over the half width of the peak, and friction makes that wider.
wear::WornChange by_resonance(const Scene& scene, const CandidateResult& result) {
  const double width = scene.loading.damping_ratio > 0
                           ? scene.loading.damping_ratio
                           : paths::amplitude_slope(result.unworn->state, 0).width / result.unworn->omega;
  const double share = std::min(1.0, scene.solver.resonance_tolerance / (2 * width));
  return {.volume = share * result.asymptote->worn_volume, .depth = share * result.asymptote->largest_depth};
}

}  // namespace

void add_worn_bars(const Scene& scene, const CandidateResult& result, Bars& bars) {
  const wear::Asymptote& asymptote = *result.asymptote;
  bars.add("search", worn_otherwise(result, by_resonance(scene, result), false));
  if (const double moved = result.evaluation.model.at("contact_edges_moved_share"); moved > 0)
    bars.add("edge", worn_otherwise(result,
                                    wear::width_changed_by(
                                        moved, {.volume = asymptote.worn_volume, .depth = asymptote.largest_depth}),
                                    moved < 1));
  if (scene.loading.follow == wear::Follow::resonance)
    bars.add("zone_ends",
             worn_otherwise(result, within_nodes(FollowedNodeParams{}.part, result.model.cells, asymptote), true));
  if (const wear::WornChange doubt = left_in_doubt(result.model.cells, asymptote); doubt.volume > 0)
    bars.add("history", worn_otherwise(result, doubt, asymptote.confirmed_by_history));
  if (asymptote.decided_by == wear::FoundBy::history) {
    constexpr HistoryErrorParams kParams;
    const double share = kParams.finished + kParams.by_tolerance * scene.solver.history_tolerance;
    bars.add("history",
             worn_otherwise(result, {.volume = share * asymptote.worn_volume, .depth = share * asymptote.largest_depth},
                            true));
  }
  if (const wear::OtherState* other = rival(asymptote); other != nullptr && result.worn) {
    // On what the ends of worn zones bear the amplitude hardly depends; on a whole other state it may.
    steady::Joint joint = joint_of(scene, result.model);
    joint.options.budget = new_budget(scene.solver, result.model);
    const paths::Resonance elsewhere =
        wear::resonance_drift(joint.worn(other->depth), *result.worn, resonance_options(scene)).worn;
    const double amplitude = elsewhere.status == Status::converged ? elsewhere.amplitude : result.unworn->amplitude;
    bars.add("history", LeftOpen{.worn_amplitude = std::abs(result.worn->amplitude - amplitude)});
  }
}

}  // namespace dovetail::optimizer
