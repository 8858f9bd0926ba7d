// The peak of pressure, which stands at the ends of flanks.
#include <algorithm>

#include "fem/stress_aggregate.hpp"
#include "geometry/profile/flank_form.hpp"
#include "optimizer/candidate/candidate_result.hpp"
#include "optimizer/responses/response_table.hpp"

namespace dovetail::optimizer {

namespace {

// Peaks on 24 and 48 edges of the quickstart and of hollow and crowned flanks with radii of 5 to 100 mm are
// 0.009 (c/d)^2 in the median off those on 160, and 0.017 (c/d)^2 at most, where c is the length of the node and d that
// over which a radius ends the singularity. The other part of it is in what meshes and other nodes say.
constexpr double kOfRounding = 0.01;
// On rough flanks of 1e13 to 3e14 N/m^3 peaks on 24 edges are at most 0.25 c k/E* below what 24, 48 and 96 edges come
// to.
constexpr double kOfRoughness = 0.3;
/// The peak is no farther from the end of the flank, by the length that rounds it off.
constexpr double kBeside = 1.5;
/// Where crowned flanks have their peak inside it is up to so much off, as a part of it.
constexpr double kAnywhere = 0.004;
/// A bar of more than this part of the peak is none: shapes that these figures know nothing of, as reliefs, have been
/// seen 1.2 of their bar off where it was 0.47 of the peak.
constexpr double kLargestBar = 0.25;
static_assert(kOfRounding < kLargestBar && kOfRoughness > kLargestBar && kAnywhere < kLargestBar,
              "nodes as long as a radius rounds resolve a peak, those as long as roughness does do not");

/// What the length of the contact node at the peak of pressure may take from it, as a part of the peak; 0 where the
/// peak is not at an end of a flank. A sharp end of rigid flanks has p = K/sqrt(x). A radius R ends that at the length
/// d where the flank has fallen behind by what such a pressure compresses, d^(3/2) = K R/E* (2 E* = E/(1 - nu^2) of
/// equal bodies): a node of length c beside it has p = 2 K/sqrt(c) and c/d = E* c/(R p/2). Springs of stiffness k
/// between rough flanks end it at E*/k.
double node_at_peak(const Scene& scene, const CandidateResult& result) {
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

double largest_pressure(const Scene& scene, const CandidateResult& result) {
  return fem::kreisselmeier_steinhauser(result.model.preload.pressure,
                                        result.model.cells.area / scene.geometry.slot_length)
      .value;
}

/// At sharp ends of flanks that are not rough it grows without limit. In space, where no bar is known for rough ones,
/// theirs as well.
bool limited(const Scene& scene) {
  const bool sharp =
      std::ranges::any_of(scene.geometry.flanks, [](const auto& flank) { return flank.edge_radius == 0; });
  return !sharp || (scene.contact.normal_stiffness > 0 && scene.kind->rough_peaks);
}

/// Meshes that do not resolve the peak may agree by accident, so the length of the node counts beside them.
double left_by_nodes(const Scene& scene, const CandidateResult& result) {
  return (kAnywhere + node_at_peak(scene, result)) * largest_pressure(scene, result);
}

}  // namespace

const Response kContactPressureMax{
    .name = "contact_pressure_max_pa",
    .unit = "Pa",
    .help =
        "Smooth maximum of the flank pressure under the spin-up load, 11.5 MPa above a uniform one; at a sharp "
        "flank end (flank_edge_radius_mm = 0) its peak does not converge with the mesh.",
    .stage = Stage::model,
    .value = largest_pressure,
    .mesh_order = {1.5},
    .by_finer_mesh = true,
    .own_error = {"contact_grid", left_by_nodes},
    .limited = limited,
    .largest_bar = kLargestBar,
    .unresolved = "The mesh does not resolve the pressure at the ends of the flanks: more mesh.flank_elements would."};

}  // namespace dovetail::optimizer
