#include "optimizer/bars/worn_bars.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "optimizer/candidate/candidate_result.hpp"
#include "optimizer/candidate/node_lines.hpp"
#include "optimizer/evaluator.hpp"
#include "wear/asymptote/drift.hpp"
#include "wear/asymptote/worn_zones.hpp"
#include "wear/measures.hpp"

namespace dovetail::optimizer {

namespace {

/// Whole nodes are worn off or bear: where wear of a history comes to rest the end of a zone lies somewhere within a
/// node, and a history on shorter ones may end a part of it from there.
wear::WornChange within_nodes(const fem::ContactCells& cells, const wear::Asymptote& asymptote) {
  // Of a node, from histories on nodes a quarter as long. Where another order of release ends elsewhere, or nodes that
  // stick have little to spare, a history depends on its nodes much more than where some touch at times only.
  const double part = asymptote.doubt == wear::Doubt::lift_off ? 0.055 : 0.25;
  // Of a history that decided nodes may touch that it has worn: they carry what is left there.
  const std::vector<bool> worn =
      asymptote.decided_by == wear::FoundBy::history ? wear::worn_nodes(asymptote.depth) : asymptote.released;
  return wear::ends_moved_by(part, node_lines(cells), cells.area, worn, asymptote.depth);
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
  return within_nodes(cells, asymptote);
}

/// What wear changes, it changes in proportion to the volume.
/// @param ends_alone  only the ends of worn zones are in doubt: on what those bear the amplitude hardly depends
void worn_otherwise(const char* source, const wear::WornChange& doubt, bool ends_alone,
                    const std::map<std::string, double>& responses, Bars& bars) {
  bars.add(source, "asymptotic_wear_volume_m3", doubt.volume);
  bars.add(source, "asymptotic_wear_depth_max_m", doubt.depth);
  const double volume = responses.at("asymptotic_wear_volume_m3");
  const double share = volume > 0 ? doubt.volume / volume : 0;
  const double drift = std::abs(responses.at("resonance_drift"));
  bars.add(source, "resonance_drift", share * drift);
  bars.add(source, "worn_resonance_hz", share * drift * responses.at("resonance_hz"));
  if (ends_alone) return;
  bars.add(source, "worn_peak_amplitude_m",
           share * std::abs(responses.at("worn_peak_amplitude_m") - responses.at("peak_amplitude_m")));
}

}  // namespace

void add_worn_bars(const Scene& scene, const CandidateResult& result, Bars& bars) {
  const std::map<std::string, double>& responses = result.evaluation.responses;
  // Of a zone of width w the depth grows like its power 3/2, the volume like 5/2.
  if (const double moved = result.evaluation.model.at("contact_edges_moved_share"); moved > 0)
    worn_otherwise("edge",
                   {.volume = std::min(1.0, 2.5 * moved) * responses.at("asymptotic_wear_volume_m3"),
                    .depth = std::min(1.0, 1.5 * moved) * responses.at("asymptotic_wear_depth_max_m")},
                   moved < 1, responses, bars);
  if (const wear::WornChange doubt = left_in_doubt(result.model.cells, *result.asymptote); doubt.volume > 0)
    worn_otherwise("history", doubt, result.asymptote->confirmed_by_history, responses, bars);
  if (const wear::OtherState* other = rival(*result.asymptote)) {
    // On what the ends of worn zones bear the amplitude hardly depends; on a whole other state it may.
    steady::Joint joint = joint_of(scene, result.model);
    joint.options.budget = new_budget(scene.solver, result.model);
    const paths::Resonance elsewhere = wear::resonance_drift(joint.worn(other->depth), *result.worn, {}).worn;
    const double amplitude =
        elsewhere.status == Status::converged ? elsewhere.amplitude : responses.at("peak_amplitude_m");
    bars.add("history", "worn_peak_amplitude_m", std::abs(responses.at("worn_peak_amplitude_m") - amplitude));
  }
}

void match_unworn_bars(CandidateResult& result) {
  if (result.asymptote->worn_volume != 0) return;
  for (const auto& [worn, same] :
       {std::pair{"worn_resonance_hz", "resonance_hz"}, std::pair{"worn_peak_amplitude_m", "peak_amplitude_m"}})
    for (const auto& [source, bar] : result.evaluation.error_sources.at(same)) {
      double& of_worn = result.evaluation.error_sources[worn][source];
      of_worn = std::max(of_worn, bar);
    }
}

}  // namespace dovetail::optimizer
