#include "optimizer/bars/unseen_zones.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "optimizer/bars/params.hpp"
#include "optimizer/candidate/node_lines.hpp"
#include "wear/asymptote/drift.hpp"
#include "wear/asymptote/worn_zones.hpp"

namespace dovetail::optimizer {

namespace {

/// A contact node at an end of what bears of a flank.
struct EndNode {
  std::size_t node = 0;
  double half_length = 0;  ///< along the flank, m
};

std::vector<EndNode> end_nodes(const Scene& scene, const CandidateResult& result) {
  const std::vector<steady::NodeSummary>& nodes = result.unworn->state.nodes;
  std::vector<EndNode> found;
  for (const fem::CellStrip& strip : result.model.cells.strips()) {
    std::size_t low = 0, high = strip.count() - 1;
    while (low < high && !nodes[strip.first + low].carries_load) ++low;
    while (low < high && !nodes[strip.first + high].carries_load) --high;
    for (const std::size_t end : {low, high})
      found.push_back({.node = strip.first + end,
                       .half_length = strip.length(end) * scene.geometry.flanks[strip.flank].length / 2});
  }
  return found;
}

struct Unseen {
  double volume = 0, depth = 0, energy = 0;  ///< m^3, m, J per cycle
};

/// Zones narrower than half a node at the ends of the contact are not seen. Such a one of width w wears until the load
/// that compresses it has gone: its end is as deep as p w / E under the pressure p, as the pressure peaks there, and on
/// rough flanks by what p compresses their asperities besides; its volume is that of a wedge. Until then it slips by
/// what the change of the pressure in a period compresses it, at its end there and back, in the mean half of that, and
/// in the mean under half the pressure. Where the pressure changes little only a part of it slips, which grows with
/// that change.
Unseen unseen(const Scene& scene, const CandidateResult& result) {
  constexpr UnseenParams kParams;
  const double modulus = std::min(scene.blade.youngs_modulus, scene.disk.youngs_modulus);
  const double roughness = scene.contact.normal_stiffness;
  Unseen left;
  for (const auto& [i, width] : end_nodes(scene, result)) {
    const steady::NodeSummary& node = result.unworn->state.nodes[i];
    const double area = result.model.cells.area[static_cast<Eigen::Index>(i)] / 2;
    const double asperities = roughness > 0 ? node.max_pressure / roughness : 0;
    const double wedge = node.max_pressure * width / modulus;
    const double change = node.max_pressure - node.min_pressure;
    const double part = change > 0 ? std::min(1.0, change / (kParams.all_of_it * node.max_pressure)) : 0;
    const double slip = change * part * width / modulus;
    left.depth = std::max(left.depth, asperities + wedge);
    left.volume += (asperities + wedge) * area / 2;
    left.energy += kParams.slipping * scene.contact.friction * node.max_pressure / 2 * part * area * slip;
  }
  return left;
}

/// By how much the joint would vibrate otherwise if those zones were worn off, where there are any: what a zone bears
/// goes to the rest, and stiffness is lost in proportion to its width. So of what changes where the whole nodes bear
/// nothing a half is left.
struct UnseenDrift {
  double drift = 0, amplitude = 0;  ///< relative; of the output
};
std::optional<UnseenDrift> unseen_drift(const Scene& scene, const CandidateResult& result) {
  steady::Joint joint = joint_of(scene, result.model);
  joint.options.budget = new_budget(scene.solver, result.model);
  joint.condition.released.assign(result.unworn->state.nodes.size(), 0);
  for (const EndNode& end : end_nodes(scene, result)) joint.condition.released[end.node] = 1;
  const wear::Drift found = wear::resonance_drift(joint, *result.unworn, resonance_options(scene));
  if (found.worn.status != Status::converged) return {};
  return UnseenDrift{.drift = std::abs(found.drift) / 2,
                     .amplitude = std::abs(found.worn.amplitude - result.unworn->amplitude) / 2};
}

}  // namespace

double add_unseen_zones(const Scene& scene, CandidateResult& result, Bars& bars) {
  const Unseen zone = unseen(scene, result);
  LeftOpen open{.worn_volume = zone.volume, .worn_depth = zone.depth};
  if (const std::optional<UnseenDrift> found = unseen_drift(scene, result)) {
    open.drift = found->drift;
    open.worn_amplitude = found->amplitude;
  } else {
    bars.leave_open(Stage::worn_resonance);
  }
  bars.add("contact_grid", open);
  if (zone.energy > result.unworn->state.friction_energy)
    result.evaluation.messages.push_back(
        "Slip at the ends of the flanks in zones narrower than half a contact node is not seen: the energy may be as "
        "large as its error bar.");
  return zone.energy;
}

double slip_at_zone_ends(const CandidateResult& result) {
  const std::vector<steady::NodeSummary>& nodes = result.unworn->state.nodes;
  Eigen::VectorXd energy(static_cast<Eigen::Index>(nodes.size()));
  std::vector<bool> loaded(nodes.size());
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    energy[static_cast<Eigen::Index>(i)] = nodes[i].dissipated_energy;
    loaded[i] = nodes[i].carries_load;
  }
  return wear::energy_left_open(node_lines(result.model.cells), result.model.cells.area, energy, loaded);
}

}  // namespace dovetail::optimizer
