#include "optimizer/candidate/candidate_result.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "optimizer/candidate/carried_over.hpp"
#include "optimizer/candidate/params.hpp"
#include "optimizer/candidate/stopwatch.hpp"
#include "optimizer/candidate/worn_state.hpp"
#include "optimizer/problem/problem.hpp"
#include "wear/asymptote/drift.hpp"
#include "wear/release/friction_reserve.hpp"

namespace dovetail::optimizer {

namespace {

void add_fillet_stresses(const Scene& scene, CandidateResult& result) {
  const fem::SectorMesh& sector = result.model.mesh.sector;
  const Eigen::MatrixXd field = displacement_field(result.model, result.unworn->state);
  result.blade_fillet = fillet_stress(scene, result.model, field, sector.blade_fillet_nodes, sector.blade_fillet_share,
                                      scene.blade.poisson_ratio);
  result.disk_fillet = fillet_stress(scene, result.model, field, sector.disk_fillet_nodes, sector.disk_fillet_share,
                                     scene.disk.poisson_ratio);
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

/// Flanks so rough that the pull of the blade moves it further than matched nodes admit. In the end so far that what is
/// left of the forces is their rounding, and nothing seems to hold it.
void note_soft_asperities(const Scene& scene, CandidateResult& result) {
  const ContactProperties& contact = scene.contact;
  if (interface_of(contact).rigid()) return;
  Evaluation& evaluation = result.evaluation;
  if (evaluation.status.ends_with(to_string(Status::singular)))
    evaluation.messages.push_back(
        "Asperities so soft (contact.normal_stiffness_n_per_m3, contact.tangential_stiffness_n_per_m3) may let the "
        "blade move so far that the balance of its forces drowns in rounding: give stiffer ones.");
  const steady::Preload& preload = result.model.preload;
  if (preload.status != Status::converged) return;
  const double pressed = contact.normal_stiffness > 0 ? preload.pressure.maxCoeff() / contact.normal_stiffness : 0;
  const double way = std::max(pressed, preload.slip_origin.cwiseAbs().maxCoeff());
  double flank = kInfinity;
  for (const geometry::FlankParameters& f : scene.geometry.flanks) flank = std::min(flank, f.length);
  if (way > AsperityParams{}.large * flank)
    evaluation.messages.push_back(
        fmt::format("The asperities of the flanks let the blade move by {:.2g} mm under its pull, where flanks are "
                    "{:.2g} mm long: nodes stay matched all the same, which holds for small ways only.",
                    1e3 * way, 1e3 * flank));
}

/// Of the loaded node that has least of its friction left.
double slip_margin(const CandidateModel& model, const steady::State& state) {
  double least = 1;
  for (Eigen::Index i = 0; i < model.condensed->nodes(); ++i)
    if (state.nodes[static_cast<std::size_t>(i)].carries_load)
      least = std::min(least, wear::friction_margin(state, i, model.condensed->contact_law(i)));
  return least;
}

std::string ended(const char* stage, const CandidateModel& model) {
  return spent(model.budget) ? failed_at(stage, Status::budget_spent) : status_of(Outcome::converged);
}

/// The peak that the unworn one has become: it is looked for where the design to begin with has it, else from where the
/// joint wore.
paths::Resonance worn_resonance(const Scene& scene, const Computation& how, const steady::Joint& joint,
                                const CandidateResult& result) {
  const wear::Asymptote& asymptote = *result.asymptote;
  paths::ResonanceOptions options = resonance_options(scene);
  const auto from = [&](const steady::State& known) {
    return wear::resonance_drift(joint.worn(asymptote.depth), *result.unworn, options, &known).worn;
  };
  if (how.from != nullptr && how.from->worn && how.from->worn->status == Status::converged) {
    steady::State known;
    known.omega = omega_as(*how.from, how.from->worn->omega, scene, result.model);
    known.displacement = displacement_as(*how.from, how.from->worn->state, scene, result.model);
    options.begins_near = true;
    paths::Resonance found = from(known);
    if (found.status == Status::converged) return found;
    options.begins_near = false;
  }
  return from(asymptote.steady);
}

/// The physics after the model; returns the status of the evaluation.
std::string dynamics(const Scene& scene, const Computation& how, CandidateResult& result) {
  Evaluation& evaluation = result.evaluation;
  const ContactFit& fit = result.fit;
  const CandidateModel& model = result.model;
  const steady::Joint joint = joint_of(scene, model, how.penalty_scale);
  Stopwatch watch;

  const NearResonance near = fit.unworn.empty() ? NearResonance() : fit.unworn.front();
  result.unworn = unworn_resonance(scene, model, joint, near, resonance_options(scene));
  evaluation.timings_s["unworn_resonance"] = watch.lap();
  if (result.unworn->status != Status::converged) return failed_at("unworn_resonance", result.unworn->status);
  add_fillet_stresses(scene, result);
  result.stage = Stage::unworn;
  evaluation.timings_s["stress"] = watch.lap();
  if (how.until <= Stage::unworn) return status_of(Outcome::converged);

  wear::Rest state = worn_state(scene, model, joint, result.unworn->state, how.history);
  result.asymptote = std::move(state.asymptote);
  result.held = std::move(state.held);
  evaluation.model["wear_frequency_hz"] = hertz(state.omegas.back());
  evaluation.timings_s["asymptote"] = watch.lap();
  const wear::Asymptote& asymptote = *result.asymptote;
  if (asymptote.verdict != wear::Verdict::asymptote)
    return failed_at("asymptote", asymptote.verdict == wear::Verdict::not_converged
                                      ? to_string(asymptote.status)
                                      : wear::to_string(asymptote.verdict));
  evaluation.model["wear_certificate"] = asymptote.certificate;
  evaluation.model["wear_bearing_share"] = asymptote.bearing.share;
  evaluation.model["wear_depth_over_compression"] = asymptote.bearing.closing;
  note_doubt(asymptote, state.unfinished, evaluation);
  if (asymptote.largest_depth == 0) evaluation.model[kSlipMargin] = slip_margin(model, result.unworn->state);
  if (const double limit = wear::AsymptoteOptions{}.certificate_limit; asymptote.certificate > limit)
    evaluation.messages.push_back(
        "wear_certificate is above " + shortest(limit) +
        ": the unworn joint hardly wears itself, and the rate that is left counts as no wear.");
  result.stage = Stage::worn_state;
  if (how.until <= Stage::worn_state) return ended("asymptote", model);

  // A joint that does not wear stays as it is.
  result.worn = asymptote.largest_depth == 0 ? *result.unworn : worn_resonance(scene, how, joint, result);
  evaluation.timings_s["worn_resonance"] = watch.lap();
  if (result.worn->status != Status::converged) return failed_at("worn_resonance", result.worn->status);
  result.stage = Stage::worn_resonance;

  return ended("worn_resonance", model);
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

paths::Resonance unworn_resonance(const Scene& scene, const CandidateModel& model, const steady::Joint& joint,
                                  const NearResonance& near, paths::ResonanceOptions options) {
  const double glued = model.glued_frequencies(scene.loading.mode - 1);
  if (near.displacement.size() == 0) return paths::resonance(joint, glued, options);
  paths::ResonanceOptions beside = options;
  beside.begins_near = true;
  beside.sweep_range = 0;
  paths::Resonance found = paths::resonance(joint, near.omega, beside, near.displacement);
  if (found.status == Status::converged || cut_short(found.status)) return found;
  paths::Resonance again = paths::resonance(joint, glued, options);
  again.solves += found.solves;
  again.jacobians += found.jacobians;
  return again;
}

double omega_as(const CandidateResult& from, double omega, const Scene& scene, const CandidateModel& model) {
  const int mode = scene.loading.mode - 1;
  return omega * (model.glued_frequencies(mode) / from.model.glued_frequencies(mode));
}

Eigen::MatrixXd displacement_as(const CandidateResult& from, const steady::State& state, const Scene& scene,
                                const CandidateModel& model) {
  return paths::padded(
      carried_over(state.displacement, from.model.cells.strips(), model.cells.strips(), model.condensed->directions()),
      scene.solver.harmonics);
}

double worn_per_energy(const CandidateResult& result, double more) {
  const dynamics::CondensedModel& model = *result.model.condensed;
  double most = 0;
  for (Eigen::Index i = 0; i < model.nodes(); ++i) {
    const contact::WearNode node = model.wear_node(i);
    const double energy = result.unworn->state.nodes[static_cast<std::size_t>(i)].dissipated_energy;
    const double beyond = std::max(0.0, energy - model.wear_law().resting_energy(node));
    most = std::max(most, model.wear_law().volume_per_energy(node, beyond + more));
  }
  return most;
}

double drift(const CandidateResult& result) {
  return result.worn->omega / result.unworn->omega - 1.0;
}

double hertz(double omega) {
  return omega / (2 * std::numbers::pi);
}

namespace {

/// Fills the result, in which the model is.
void go_through_stages(const Scene& scene, const Computation& how, CandidateResult& result) {
  Evaluation& evaluation = result.evaluation;
  evaluation.parameters = parameters(scene);
  evaluation.model = result.model.sizes;
  evaluation.timings_s = result.model.timings_s;
  evaluation.messages = result.model.messages;
  evaluation.status = result.model.status;
  for (const geometry::Rule& rule : result.model.feasibility.rules)
    evaluation.constraints[kRulePrefix + rule.name] = -rule.margin;
  evaluation.feasible = result.model.feasibility.feasible;
  if (!result.model.converged()) return;
  Stopwatch watch;
  const ContactFit& fit = result.fit = fit_contact(scene, how, result.model);
  evaluation.timings_s["contact_fit"] = watch.lap();
  evaluation.model["contact_grids"] = fit.grids;
  evaluation.model["contact_edges"] = fit.edges;
  evaluation.model["contact_edges_moved"] = fit.moved;
  evaluation.model["contact_edges_moved_share"] = fit.settled ? 0 : fit.share;
  evaluation.model["contact_nodes"] = static_cast<double>(result.model.cells.count());
  evaluation.status = result.model.status;
  if (!result.model.converged()) return;
  result.stage = Stage::model;
  evaluation.status = how.until == Stage::model ? status_of(Outcome::converged) : dynamics(scene, how, result);
  if (!fit.settled && result.unworn->status == Status::converged)
    evaluation.messages.push_back(
        fit.spent ? "Contact nodes need not end where worn zones do: the share of the budget (solver.max_jacobians, "
                    "solver.time_limit_s) for finding out where that is was spent."
        : fit.known
            ? "The edges of the worn zones did not settle: their contact nodes end beside them, by up to " +
                  fmt::format("{:.2g}", fit.moved) + " of an edge of the mesh."
            : "Contact nodes need not end where worn zones do: on one of the grids that were laid to find out where "
              "that is there was no steady or no worn state.");
  note_penalties(result);
  evaluation.model["jacobians_spent"] = result.model.budget->used() / result.model.jacobian_operations;
}

}  // namespace

CandidateResult through_stages(const Scene& scene, CandidateModel model, const Computation& how) {
  CandidateResult result;
  result.model = std::move(model);
  go_through_stages(scene, how, result);
  note_soft_asperities(scene, result);
  return result;
}

}  // namespace dovetail::optimizer
