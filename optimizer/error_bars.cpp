#include "optimizer/error_bars.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <utility>

#include "optimizer/responses.hpp"
#include "response/resonance.hpp"

namespace dovetail::optimizer {

namespace {

constexpr double kRatio = 1.5;

/// A change of settings and what its effect on a response says about the error left.
struct Source {
  const char* name;
  double (*factor)(const std::string& response);
};

template <int numerator, int denominator>
double share(const std::string&) {
  return static_cast<double>(numerator) / denominator;
}

/// With an error of order p, d to a mesh 1.5 times as coarse leaves d / (1.5^p - 1).
double left_over(double order) {
  return 1 / (std::pow(kRatio, order) - 1);
}

// The orders were chosen while looking at random designs against meshes four times as fine (studies/error_bars, seed
// 1).
double mesh_factor(const std::string& response) {
  // Forces that follow from equilibrium know of the mesh only through its quadratic arcs.
  if (response == "contact_pressure_mean_pa" || response == "neck_tension_pa") return left_over(4);
  // Energies of the whole, into which the ends of the flanks enter with the square of their error; stresses of fillets,
  // for which what the free surface says of them counts besides.
  if (response == "glued_frequency_hz" || response == "resonance_hz" || response == "worn_resonance_hz" ||
      response == "resonance_drift" || response.ends_with("_stress_pa"))
    return left_over(2);
  // The worn joint bears on its inner parts.
  if (response == "worn_peak_amplitude_m") return left_over(4.0 / 3);
  // Slip next to the sharp ends of flanks.
  return left_over(1);
}

/// Nodes 1.5 times as long on the same mesh, which the coarse mesh has as well: what they change is in both.
double grid_factor(const std::string& response) {
  return left_over(response == "worn_peak_amplitude_m" ? 7.0 / 3 : 5.0 / 3);
}

class Bars {
 public:
  explicit Bars(CandidateResult& result) : evaluation_(result.evaluation) {}

  /// The effect of `changed` against `reference`, for every response of the evaluation.
  void add(const Source& source, const Evaluation& changed, const Evaluation& reference) {
    const bool known = changed.converged() && reference.converged();
    if (!known)
      evaluation_.messages.push_back(std::string("No bar for the error by ") + source.name +
                                     ": the design computed for it ended with \"" +
                                     (changed.converged() ? reference.status : changed.status) + "\".");
    for (const auto& [name, value] : evaluation_.responses) {
      if (!known) {
        open_.insert(name);
        continue;
      }
      add(source.name, name, source.factor(name) * std::abs(changed.responses.at(name) - reference.responses.at(name)));
    }
  }
  void add(const char* source, const std::string& response, double bar) {
    evaluation_.error_sources[response][source] += bar;
  }
  void leave_open(const std::string& response) { open_.insert(response); }

  void total() {
    for (const auto& [response, sources] : evaluation_.error_sources) {
      if (open_.contains(response)) continue;
      double sum = 0;
      for (const auto& [source, bar] : sources) sum += bar;
      evaluation_.error_estimates[response] = sum;
    }
    evaluation_.unbounded.assign(open_.begin(), open_.end());
  }

 private:
  Evaluation& evaluation_;
  std::set<std::string> open_;
};

}  // namespace

Scene coarsened(Scene scene) {
  const auto fewer = [](int count, int least) {
    return std::max(least, static_cast<int>(std::lround(count / kRatio)));
  };
  scene.mesh.flank_elements = fewer(scene.mesh.flank_elements, 4);
  scene.mesh.aerofoil_elements = fewer(scene.mesh.aerofoil_elements, 2);
  if (!scene.in_space()) {
    scene.mesh.fillet_fraction = std::min(1.0, kRatio * scene.mesh.fillet_fraction);
    scene.mesh.blend_fraction = std::min(2.0, kRatio * scene.mesh.blend_fraction);
    scene.mesh.bulk_size = std::min(0.1, kRatio * scene.mesh.bulk_size);
  }
  scene.solid_mesh.slot_elements = fewer(scene.solid_mesh.slot_elements, 2);
  if (scene.solid_mesh.contact_slot_elements > 0)
    scene.solid_mesh.contact_slot_elements = fewer(scene.solid_mesh.contact_slot_elements, 2);
  if (scene.solid_mesh.contact_flank_elements > 0)
    scene.solid_mesh.contact_flank_elements = fewer(scene.solid_mesh.contact_flank_elements, 2);
  return scene;
}

void add_error_bars(const Scene& scene, const ModelBuilder& builder, CandidateResult& result) {
  Bars bars(result);
  const Scene coarse = coarsened(scene);
  const CandidateModel model = builder.build(coarse);
  const auto companion = [](const Scene& of, CandidateModel on, const Computation& how = {}) {
    if (on.converged()) renew_budget(of.solver, on);
    return computed(of, std::move(on), how).evaluation;
  };
  const auto cells = [](double longer) {
    Computation how;
    how.contact.lengths.finest *= longer;
    how.contact.lengths.coarsest *= longer;
    return how;
  };
  const Evaluation reference = companion(coarse, model);
  bars.add({"mesh", mesh_factor}, reference, result.evaluation);
  bars.add({"contact_grid", grid_factor}, companion(scene, result.model, cells(kRatio)), result.evaluation);
  // Worn zones narrower than the contact nodes are not seen.
  if (result.asymptote->worn_volume == 0)
    bars.add({"contact_grid", share<2, 1>}, companion(scene, result.model, cells(0.5)), result.evaluation);

  Scene changed = coarse;
  changed.solver.harmonics = 2 * coarse.solver.harmonics + 1;
  while (changed.solver.samples < 4 * changed.solver.harmonics + 4) changed.solver.samples *= 2;
  bars.add({"harmonics", share<2, 1>}, companion(changed, model), reference);
  changed = coarse;
  changed.solver.samples *= 2;
  bars.add({"samples", share<2, 1>}, companion(changed, model), reference);
  bars.add({"pseudo_penalty", share<1, 2>}, companion(coarse, model, {.contact = {}, .penalty_scale = 0.5}), reference);
  changed = coarse;
  changed.solver.modes *= 2;
  bars.add({"modes", share<3, 2>}, companion(changed, builder.build(changed)), reference);

  bars.add("mesh", "blade_fillet_stress_pa", result.blade_fillet->aggregate_error);
  bars.add("mesh", "disk_fillet_stress_pa", result.disk_fillet->aggregate_error);
  bars.add("mesh", "peak_stress_pa", std::max(result.blade_fillet->maximum_error, result.disk_fillet->maximum_error));
  const double tolerance = response::ResonanceOptions{}.frequency_tolerance;
  for (const char* name : {"resonance_hz", "worn_resonance_hz"})
    bars.add("search", name, tolerance * result.evaluation.responses.at(name));
  bars.add("search", "resonance_drift", 2 * tolerance);
  // Of a zone of width w the depth grows like its power 3/2, the volume like 5/2.
  const double moved = result.evaluation.model.at("contact_edges_moved_share");
  for (const auto& [name, power] : {std::pair{"asymptotic_wear_volume_m3", 2.5}, std::pair{"resonance_drift", 2.5},
                                    std::pair{"asymptotic_wear_depth_max_m", 1.5}})
    if (moved > 0)
      bars.add("edge", name, std::min(1.0, power * moved) * std::abs(result.evaluation.responses.at(name)));
  for (const std::string& name : responses_without_limit(scene)) bars.leave_open(name);
  bars.total();
}

}  // namespace dovetail::optimizer
