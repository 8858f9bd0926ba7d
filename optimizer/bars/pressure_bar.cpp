#include "optimizer/bars/pressure_bar.hpp"

#include <algorithm>

#include "geometry/profile/flank_form.hpp"
#include "optimizer/candidate/candidate_result.hpp"

namespace dovetail::optimizer {

namespace {

/// What the length of the contact node at the peak of pressure may take from it, as a part of the peak; 0 where the
/// peak is not at an end of a flank. A sharp end of rigid flanks has p = K/sqrt(x). A radius R ends that at the length
/// d where the flank has fallen behind by what such a pressure compresses, d^(3/2) = K R/E* (2 E* = E/(1 - nu^2) of
/// equal bodies): a node of length c beside it has p = 2 K/sqrt(c) and c/d = E* c/(R p/2). Springs of stiffness k
/// between rough flanks end it at E*/k. Peaks on 24 and 48 edges of the quickstart and of hollow and crowned flanks
/// with radii of 5 to 100 mm are 0.009 (c/d)^2 in the median off those on 160, and 0.017 (c/d)^2 at most. On rough
/// flanks of 1e13 to 3e14 N/m^3 peaks on 24 edges are at most 0.25 c k/E* below what 24, 48 and 96 edges come to.
double node_at_peak(const Scene& scene, const CandidateResult& result) {
  constexpr double kOfRounding = 0.01, kOfRoughness = 0.3;  // the first beside what meshes and other nodes say
  constexpr double kBeside = 1.5;  // the peak is no farther from the end of the flank, by the length that rounds it off
  const auto plane = [](const fem::Material& of) {
    return (1 - of.poisson_ratio * of.poisson_ratio) / of.youngs_modulus;
  };
  const double compliance = plane(scene.blade) + plane(scene.disk);  // 1/E*
  const double roughness = scene.contact.normal_stiffness;
  Eigen::Index at_peak = 0;
  const double peak = result.model.preload.pressure.maxCoeff(&at_peak);
  const auto node = static_cast<std::size_t>(at_peak);
  for (const fem::CellStrip& strip : result.model.cells.strips()) {
    if (node < strip.first || node >= strip.first + strip.count()) continue;
    const geometry::FlankParameters& form = scene.geometry.flanks[strip.flank];
    const double rounded =
        std::max(geometry::rounded_length(form.edge_radius), roughness > 0 ? 1 / (roughness * compliance) : 0);
    const double beside = kBeside * rounded / form.length;
    const std::size_t k = node - strip.first;
    if (strip.ends[k] > beside && strip.ends[k + 1] < 1 - beside) return 0;
    const double length = strip.length(k) * form.length;
    const double radii = form.edge_radius > 0 ? length / (form.edge_radius * peak * compliance / 2) : kInfinity;
    const double springs = roughness > 0 ? length * roughness * compliance : kInfinity;
    return std::min(kOfRounding * radii * radii, kOfRoughness * springs);
  }
  return 0;
}

}  // namespace

void add_peak_pressure(const Scene& scene, CandidateResult& result, Bars& bars) {
  // Meshes that do not resolve the peak may agree by accident, so the length of the node counts beside them. Where
  // crowned flanks have their peak inside, it is up to 0.4 % off. A bar of more than a quarter of the peak is none:
  // shapes that these figures know nothing of, as reliefs, have been seen 1.2 of their bar off where it was 0.47 of the
  // peak.
  constexpr double kAnywhere = 0.004, kNone = 0.25;
  const char* name = "contact_pressure_max_pa";
  const double peak = result.evaluation.responses.at(name);
  bars.add("contact_grid", name, (kAnywhere + node_at_peak(scene, result)) * peak);
  if (bars.sum(name) <= kNone * peak) return;
  bars.leave_open(name);
  result.evaluation.messages.push_back(
      "The mesh does not resolve the pressure at the ends of the flanks: more mesh.flank_elements would.");
}

}  // namespace dovetail::optimizer
