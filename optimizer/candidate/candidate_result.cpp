#include "optimizer/candidate/candidate_result.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "fem/neck.hpp"
#include "fem/stress_aggregate.hpp"
#include "geometry/profile/measures.hpp"
#include "optimizer/candidate/stopwatch.hpp"
#include "optimizer/candidate/worn_state.hpp"
#include "optimizer/problem/problem.hpp"
#include "wear/asymptote/drift.hpp"
#include "wear/measures.hpp"

namespace dovetail::optimizer {

namespace {

double hertz(double omega) {
  return omega / (2 * std::numbers::pi);
}

void static_responses(const Scene& scene, const CandidateModel& model, Evaluation& evaluation) {
  std::map<std::string, double>& responses = evaluation.responses;
  const geometry::Profile profile = geometry::build_profile(scene.geometry);
  const std::vector<fem::Material> bodies = materials(scene);
  responses["mass_kg"] = scene.kind->blade_mass(scene, model.mesh.sector.mesh);
  responses["post_width_m"] = geometry::measure(profile, scene.geometry).post;

  const double load = scene.loading.speed * scene.loading.speed;
  responses["neck_tension_pa"] = load * fem::neck_tension(model.mesh.sector, bodies).mean_stress;

  const fem::ContactCells& surface = model.cells;
  responses["contact_pressure_max_pa"] =
      fem::kreisselmeier_steinhauser(model.preload.pressure, surface.area / scene.geometry.slot_length).value;
  double mean = 0;
  for (int flank = 0; flank < static_cast<int>(model.mesh.sector.flanks.size()); ++flank) {
    double force = 0, area = 0;
    for (Eigen::Index i = 0; i < surface.count(); ++i) {
      if (surface.flank(i) != flank) continue;
      force += model.preload.pressure(i) * surface.area(i);
      area += surface.area(i);
    }
    mean = std::max(mean, force / area);
  }
  responses["contact_pressure_mean_pa"] = mean;
  responses["glued_frequency_hz"] = hertz(reduction::glued_frequencies(model.trace)(scene.loading.mode - 1));
}

void fillet_responses(const Scene& scene, CandidateResult& result) {
  const fem::SectorMesh& sector = result.model.mesh.sector;
  const steady::State& state = result.unworn->state;
  result.blade_fillet = fillet_stress(scene, result.model, state, sector.blade_fillet_nodes, sector.blade_fillet_share,
                                      scene.blade.poisson_ratio);
  result.disk_fillet = fillet_stress(scene, result.model, state, sector.disk_fillet_nodes, sector.disk_fillet_share,
                                     scene.disk.poisson_ratio);
  std::map<std::string, double>& responses = result.evaluation.responses;
  responses["blade_fillet_stress_pa"] = result.blade_fillet->aggregate;
  responses["disk_fillet_stress_pa"] = result.disk_fillet->aggregate;
  responses["peak_stress_pa"] = std::max(result.blade_fillet->maximum, result.disk_fillet->maximum);
}

/// States that needed another pseudo-penalty than the one asked for: their truncation errors are others.
void note_penalties(CandidateResult& result) {
  double& farthest = result.evaluation.model["penalty_ratio"] = 1;
  const auto note = [&](const char* what, const steady::State& state) {
    if (state.status != Status::converged || state.penalty_ratio == 1) return;
    if (std::abs(std::log(state.penalty_ratio)) > std::abs(std::log(farthest))) farthest = state.penalty_ratio;
    result.evaluation.messages.push_back(std::string("The ") + what + " was found with " +
                                         shortest(state.penalty_ratio) + " times the pseudo-penalty.");
  };
  if (result.unworn) note("unworn resonance", result.unworn->state);
  if (result.asymptote) note("worn state", result.asymptote->steady);
  if (result.worn) note("worn resonance", result.worn->state);
}

/// The physics after the model; returns the status of the evaluation.
std::string dynamics(const Scene& scene, const Computation& how, const ContactFit& fit, CandidateResult& result) {
  Evaluation& evaluation = result.evaluation;
  std::map<std::string, double>& responses = evaluation.responses;
  const CandidateModel& model = result.model;
  const steady::Joint joint = joint_of(scene, model, how.penalty_scale);
  Stopwatch watch;

  const double start =
      fit.displacement.size() > 0 ? fit.omega : model.reduction.glued_frequencies(scene.loading.mode - 1);
  result.unworn = paths::resonance(joint, start, {}, fit.displacement);
  evaluation.timings_s["unworn_resonance"] = watch.lap();
  if (result.unworn->status != Status::converged)
    return "unworn_resonance: " + std::string(to_string(result.unworn->status));
  responses["resonance_hz"] = hertz(result.unworn->omega);
  responses["peak_amplitude_m"] = result.unworn->amplitude;
  responses["dissipated_energy_j"] = result.unworn->state.friction_energy;
  responses["initial_wear_rate_m3_per_cycle"] = wear::worn_volume(model.model.contact, result.unworn->state.wear_rate);
  fillet_responses(scene, result);
  evaluation.timings_s["stress"] = watch.lap();
  if (!how.wear) return "converged";

  wear::Rest state = worn_state(scene, model, joint, result.unworn->state, how.history);
  result.asymptote = std::move(state.asymptote);
  result.held = std::move(state.held);
  evaluation.model["wear_frequency_hz"] = hertz(state.omegas.back());
  evaluation.timings_s["asymptote"] = watch.lap();
  const wear::Asymptote& asymptote = *result.asymptote;
  if (asymptote.verdict != wear::Verdict::asymptote)
    return "asymptote: " + std::string(asymptote.verdict == wear::Verdict::not_converged
                                           ? to_string(asymptote.status)
                                           : wear::to_string(asymptote.verdict));
  evaluation.model["wear_certificate"] = asymptote.certificate;
  evaluation.model["wear_bearing_share"] = asymptote.bearing.share;
  evaluation.model["wear_depth_over_compression"] = asymptote.bearing.closing;
  note_doubt(asymptote, state.unfinished, evaluation);
  if (const double limit = wear::AsymptoteOptions{}.certificate_limit; asymptote.certificate > limit)
    evaluation.messages.push_back(
        "wear_certificate is above " + shortest(limit) +
        ": the unworn joint hardly wears itself, and the rate that is left counts as no wear.");
  responses["asymptotic_wear_volume_m3"] = asymptote.worn_volume;
  responses["asymptotic_wear_depth_max_m"] = asymptote.largest_depth;

  // A joint that does not wear stays as it is.
  const wear::Drift drift = asymptote.largest_depth == 0
                                ? wear::Drift{.unworn = *result.unworn, .worn = *result.unworn}
                                : wear::resonance_drift(joint.worn(asymptote.depth), *result.unworn, {});
  result.worn = drift.worn;
  evaluation.timings_s["worn_resonance"] = watch.lap();
  if (result.worn->status != Status::converged) return "worn_resonance: " + std::string(to_string(result.worn->status));
  responses["worn_resonance_hz"] = hertz(result.worn->omega);
  responses["resonance_drift"] = drift.drift;
  responses["worn_peak_amplitude_m"] = result.worn->amplitude;

  return spent(model.budget) ? "worn_resonance: " + std::string(to_string(Status::budget_spent)) : "converged";
}

}  // namespace

steady::Options steady_options(const SolverSettings& settings) {
  return {
      .harmonics = settings.harmonics,
      .samples = settings.samples,
      .tolerance = settings.tolerance,
      .solver = settings.solver,
      .normal_penalty = settings.pseudo_penalty_normal > 0 ? settings.pseudo_penalty_normal : settings.pseudo_penalty,
      .tangential_penalty = settings.pseudo_penalty};
}

steady::Joint joint_of(const Scene& scene, const CandidateModel& model, double penalty_scale) {
  steady::Joint joint{.model = model.condensed, .options = steady_options(scene.solver)};
  joint.options.budget = model.budget;
  joint.options.penalty_scale = penalty_scale;
  return joint;
}

CandidateResult computed(const Scene& scene, CandidateModel model, const Computation& how) {
  CandidateResult result;
  result.model = std::move(model);
  Evaluation& evaluation = result.evaluation;
  evaluation.parameters = parameters(scene);
  evaluation.model = result.model.sizes;
  evaluation.timings_s = result.model.timings_s;
  evaluation.messages = result.model.messages;
  evaluation.status = result.model.status;
  for (const geometry::Rule& rule : result.model.feasibility.rules)
    evaluation.constraints[kRulePrefix + rule.name] = -rule.margin;
  evaluation.feasible = result.model.feasibility.feasible;
  if (!result.model.converged()) return result;
  Stopwatch watch;
  const ContactFit fit = fit_contact(scene, how, result.model);
  evaluation.timings_s["contact_fit"] = watch.lap();
  evaluation.model["contact_grids"] = fit.grids;
  evaluation.model["contact_edges"] = fit.edges;
  evaluation.model["contact_edges_moved"] = fit.moved;
  evaluation.model["contact_edges_moved_share"] = fit.settled ? 0 : fit.share;
  evaluation.model["contact_nodes"] = static_cast<double>(result.model.cells.count());
  evaluation.status = result.model.status;
  if (!result.model.converged()) return result;
  static_responses(scene, result.model, evaluation);
  evaluation.status = dynamics(scene, how, fit, result);
  if (!fit.settled && result.unworn->status == Status::converged)
    evaluation.messages.push_back(
        fit.known
            ? "The edges of the worn zones did not settle: their contact nodes end beside them, by up to " +
                  fmt::format("{:.2g}", fit.moved) + " of an edge of the mesh."
            : "Contact nodes do not end where worn zones do: on the nodes of the mesh the direct method found no worn "
              "state to take their edges from.");
  note_penalties(result);
  evaluation.model["jacobians_spent"] = result.model.budget->used() / result.model.jacobian_operations;
  return result;
}

}  // namespace dovetail::optimizer
