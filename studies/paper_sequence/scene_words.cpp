#include "studies/paper_sequence/scene_words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "optimizer/scene/scene_kind.hpp"
#include "studies/paper_sequence/findings.hpp"
#include "studies/report/words/units.hpp"

namespace dovetail::paper_sequence {

using report::significant;

const SceneWords& scene_words(const optimizer::Scene& scene) {
  static const SceneWords section{
      .title = "in a plane section",
      .column = "The plane section",
      .where = "a plane section of its joint",
      .such = "a plane section of such a joint",
      .difference = "The reference is a model in space; this is a plane section, uniform along the slot.",
      .families =
          " The section carries bending in its own plane only: families of torsion and edgewise bending are missing.",
      .options = {},
      .quick_flank_elements = 16,
      .quick_aerofoil_elements = 12};
  // Each point and each diameter costs a hundred times those of a section.
  static const SceneWords sector{
      .title = "in space",
      .column = "The sector in space",
      .where = "one sector of such a disk in space",
      .such = "one sector of such a disk in space",
      .difference =
          "The dimensions, the twist of the blade and the speed are not the reference\u2019s, which gives none.",
      .families = "",
      .options = {.curve_points = 61, .history_steps = 50, .curve_states = 5, .nodal_diameter_modes = 4},
      .quick_flank_elements = 6,
      .quick_aerofoil_elements = 6};
  static const std::map<const optimizer::SceneKind*, const SceneWords*> words{{&optimizer::kSection, &section},
                                                                              {&optimizer::kSector, &sector}};
  return *words.at(scene.kind);
}

namespace {

/// "2 mm from the neck side of the left flank, 5 mm from the middle of the slot": where a node is.
std::string place(const Results& r, std::size_t node) {
  const report::ContactRecord& contact = r.design.contact;
  std::string text = significant(contact.along_m[node] / 1e-3, 2) + "\u00a0mm from the neck side of the " +
                     contact.flank_names[static_cast<std::size_t>(contact.flank[node])] + " flank";
  if (r.in_space())
    text += ", " + significant(std::abs(contact.across_m[node]) / 1e-3, 2) + "\u00a0mm from the middle of the slot";
  return text;
}

/// Normal force of a flank, N.
double flank_force(const report::ContactRecord& contact, std::int64_t flank) {
  double force = 0;
  for (std::size_t i = 0; i < contact.flank.size(); ++i)
    if (contact.flank[i] == flank) force += contact.preload_pressure_pa[i] * contact.area_m2[i];
  return force;
}

}  // namespace

std::string pressure_text(const Results& r) {
  const report::ContactRecord& contact = r.design.contact;
  double force = 0, area = 0;
  int open = 0;
  for (std::size_t i = 0; i < contact.preload_pressure_pa.size(); ++i) {
    force += contact.preload_pressure_pa[i] * contact.area_m2[i];
    area += contact.area_m2[i];
    if (!(contact.preload_pressure_pa[i] > 0)) ++open;
  }
  const std::string where =
      open == 0 ? fmt::format(
                      "All {} contact nodes touch; on the neck side, where the hoop growth of the disk opens the "
                      "slot, they are pressed least.",
                      contact.flank.size())
                : fmt::format(
                      "{} of {} contact nodes do not touch: the hoop growth of the disk opens the slot on the "
                      "neck side.",
                      open, contact.flank.size());
  const Largest most = largest_of(contact.preload_pressure_pa);
  return fmt::format(
      "The mean pressure is {}\u00a0MPa, the largest {}\u00a0MPa, {}. {} The left flank carries {}\u00a0kN, the right "
      "one {}\u00a0kN.",
      significant(force / area / 1e6, 3), significant(most.value / 1e6, 3), place(r, most.at), where,
      significant(flank_force(contact, 0) / 1e3, 4), significant(flank_force(contact, 1) / 1e3, 4));
}

std::string frequency_text(const Results& r) {
  const report::NodalDiameterRecord& record = r.design.nodal_diameters;
  if (record.frequency_hz.empty() || record.modes < 1) return "The frequencies were not computed.";
  const auto modes = static_cast<std::size_t>(record.modes);
  const double at_zero = record.frequency_hz.front();
  const double at_most = record.frequency_hz[(record.nodal_diameter.size() - 1) * modes];
  return fmt::format(
      "The first family, the flexural mode of the blade, goes from {} Hz without nodal diameters to {} Hz with {}; the "
      "wear computations are for none, at {} Hz with friction.{}",
      significant(at_zero, 5), significant(at_most, 5), record.nodal_diameter.back(), significant(r.resonance_hz, 6),
      scene_words(r.scene).families);
}

std::string first_rate_text(const Results& r) {
  const Numbers& rate = r.design.contact.wear_rate_m_per_cycle;
  const Largest most = largest_of(rate);
  if (!(most.value > 0)) return "No contact node wears.";
  const auto wearing = std::count_if(rate.begin(), rate.end(), [&](double v) { return v > 0.01 * most.value; });
  double farthest = 0;
  for (std::size_t i = 0; i < rate.size(); ++i)
    if (rate[i] > 0.01 * most.value) farthest = std::max(farthest, r.design.contact.along_m[i]);
  return fmt::format(
      "{} of {} contact nodes wear by more than a hundredth of the largest rate, none of them farther than "
      "{}\u00a0mm from the neck side. The largest rate is {}.",
      wearing, rate.size(), significant(farthest / 1e-3, 2), place(r, most.at));
}

}  // namespace dovetail::paper_sequence
