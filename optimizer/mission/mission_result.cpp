#include "optimizer/mission/mission_result.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "optimizer/candidate/candidate_result.hpp"
#include "optimizer/candidate/node_lines.hpp"
#include "optimizer/problem/load_case.hpp"
#include "optimizer/responses/response_table.hpp"
#include "wear/asymptote/drift.hpp"
#include "wear/asymptote/worn_zones.hpp"
#include "wear/measures.hpp"

namespace dovetail::optimizer {

namespace {

std::string response_name(const Response& response) {
  return std::string(response.name);
}

/// A number for the evaluation's `model`.
double& told(Evaluation& evaluation, const char* what) {
  return evaluation.model[std::string(kMissionPrefix) + what];
}

/// Where a load on the nodes of `from` is looked for on those of a model.
FitStart start_of(const MissionResult& from, std::size_t k, const Scene& scene, const CandidateModel& model,
                  bool grid) {
  if (k >= from.unworn.size()) return {};
  const int mode = scene.loading.mode - 1;
  return {.unworn = {.omega = from.unworn[k].omega *
                              (model.glued_frequencies(mode) / from.models[k].glued_frequencies(mode)),
                     .displacement = from.unworn[k].state.displacement},
          .strips = from.models[k].cells.strips(),
          .grid = grid ? &from.fit.grid : nullptr};
}

class MissionStages {
 public:
  MissionStages(const MissionLoads& loads, const Computation& how, MissionResult& result)
      : loads_(loads.all), how_(how), result_(result) {}

  /// The status of the evaluation.
  [[nodiscard]] std::string go_through(const MissionResult* from) {
    for (const CandidateModel& model : result_.models)
      if (!model.converged()) return model.status;
    if (!fit(from)) return failed_fit_;
    for (std::size_t k = 0; k < loads_.size(); ++k)
      if (const Status status = find_unworn(k); status != Status::converged)
        return failed_at("unworn_resonance", of_case(to_string(status), loads_[k].name));
    result_.mission = wear::mission(wear_loads(), options());
    const wear::Mission& mission = *result_.mission;
    if (mission.verdict != wear::Verdict::asymptote) return ended(mission);
    for (std::size_t k = 0; k < loads_.size(); ++k)
      if (const Status status = find_worn(k); status != Status::converged)
        return failed_at("worn_resonance", of_case(to_string(status), loads_[k].name));
    answer(mission);
    for (const CandidateModel& model : result_.models)
      if (spent(model.budget)) return failed_at("worn_resonance", Status::budget_spent);
    return status_of(Outcome::converged);
  }

 private:
  [[nodiscard]] bool fit(const MissionResult* from) {
    std::vector<FlankLoad> on;
    for (std::size_t k = 0; k < loads_.size(); ++k) {
      CandidateModel& model = result_.models[k];
      FlankLoad& load = on.emplace_back(FlankLoad{.scene = &loads_[k].scene, .model = &model});
      if (from != nullptr) load.start = start_of(*from, k, loads_[k].scene, model, how_.grid_from);
    }
    result_.fit = fit_contact(on, how_);
    result_.fit.unworn.resize(loads_.size());
    for (const CandidateModel& model : result_.models)
      if (!model.converged()) failed_fit_ = model.status;
    Evaluation& evaluation = result_.evaluation;
    told(evaluation, "contact_grids") = result_.fit.grids;
    told(evaluation, "contact_edges_moved_share") = result_.fit.settled ? 0 : result_.fit.share;
    told(evaluation, "contact_nodes") = static_cast<double>(result_.models.front().cells.count());
    return failed_fit_.empty();
  }

  [[nodiscard]] steady::Joint joint(std::size_t k) const {
    return joint_of(loads_[k].scene, result_.models[k], how_.penalty_scale);
  }

  [[nodiscard]] Status find_unworn(std::size_t k) {
    const Scene& scene = loads_[k].scene;
    result_.unworn.push_back(
        unworn_resonance(scene, result_.models[k], joint(k), result_.fit.unworn[k], resonance_options(scene)));
    return result_.unworn.back().status;
  }

  [[nodiscard]] std::vector<wear::MissionLoad> wear_loads() const {
    std::vector<wear::MissionLoad> all;
    for (std::size_t k = 0; k < loads_.size(); ++k)
      all.push_back({.joint = joint(k),
                     .omega = result_.unworn[k].omega,
                     .share = loads_[k].share,
                     .unworn = &result_.unworn[k].state});
    return all;
  }

  [[nodiscard]] wear::MissionOptions options() const {
    wear::MissionOptions options;
    options.lines = node_lines(result_.models.front().cells);
    options.turns = how_.history;
    const SolverSettings& solver = loads_.front().scene.solver;
    options.asymptote.history_tolerance = solver.history_tolerance;
    options.asymptote.certify_finer = false;
    options.asymptote.history_budget = [&model = result_.models.front(), solver](const steady::Options& settings) {
      SolverSettings there = solver;
      there.harmonics = settings.harmonics;
      there.samples = settings.samples;
      return new_budget(there, model);
    };
    return options;
  }

  [[nodiscard]] std::string ended(const wear::Mission& mission) const {
    const std::string_view why =
        mission.verdict == wear::Verdict::not_converged ? to_string(mission.status) : to_string(mission.verdict);
    return failed_at("asymptote", why);
  }

  /// A joint that does not wear stays as it is.
  [[nodiscard]] Status find_worn(std::size_t k) {
    const wear::Mission& mission = *result_.mission;
    result_.worn.push_back(mission.largest_depth == 0
                               ? result_.unworn[k]
                               : wear::resonance_drift(joint(k).worn(mission.depth), result_.unworn[k],
                                                       resonance_options(loads_[k].scene), &mission.states[k])
                                     .worn);
    return result_.worn.back().status;
  }

  void answer(const wear::Mission& mission) {
    Evaluation& evaluation = result_.evaluation;
    evaluation.responses[response_name(kMissionVolume)] = mission.worn_volume;
    evaluation.responses[response_name(kMissionDepth)] = mission.largest_depth;
    for (std::size_t k = 0; k < loads_.size(); ++k)
      evaluation.responses[of_case(kMissionDrift.name, loads_[k].name)] =
          result_.worn[k].omega / result_.unworn[k].omega - 1;
    told(evaluation, "loads") = static_cast<double>(loads_.size());
    if (!mission.took_turns) return;
    told(evaluation, "order_matters") = mission.order_matters ? 1 : 0;
    told(evaluation, "least_volume_m3") = mission.least_volume;
    told(evaluation, "largest_volume_m3") = mission.largest_volume;
    if (mission.order_matters)
      evaluation.messages.push_back(
          fmt::format("The order of the cases matters for what they wear off together: {:.4g} to {:.4g} m^3 in those "
                      "tried.",
                      mission.least_volume, mission.largest_volume));
  }

  const std::vector<MissionLoads::Load>& loads_;
  const Computation& how_;
  MissionResult& result_;
  std::string failed_fit_;
};

}  // namespace

MissionResult mission_of(const MissionLoads& loads, std::vector<CandidateModel> models, const Computation& how,
                         const MissionResult* from) {
  MissionResult result;
  result.models = std::move(models);
  result.evaluation.status = MissionStages(loads, how, result).go_through(from);
  double& spent = told(result.evaluation, "jacobians_spent") = 0;
  for (const CandidateModel& model : result.models)
    if (model.budget) spent += model.budget->used() / model.jacobian_operations;
  return result;
}

void confirm_by_history(const MissionLoads& loads, MissionResult& result, const AlternatingOptions& options) {
  Evaluation& evaluation = result.evaluation;
  if (!evaluation.converged() || result.mission->largest_depth == 0) return;
  std::array<double, 2> volume{};
  Eigen::VectorXd depth;
  for (const std::size_t i : {0, 1}) {
    std::vector<wear::MissionLoad> all;
    double penetration = 0;
    for (std::size_t k = 0; k < loads.all.size(); ++k) {
      const MissionLoads::Load& load = loads.all[k];
      steady::Joint joint = joint_of(load.scene, result.models[k]);
      joint.options.budget = new_budget(load.scene.solver, result.models[k], options.budgets);
      all.push_back({.joint = std::move(joint), .omega = result.unworn[k].omega, .share = load.share});
      penetration =
          std::max(penetration, wear::largest_penetration(*result.models[k].condensed, result.unworn[k].state));
    }
    const wear::MissionHistory history =
        wear::mission_history(all, {.increment = std::ldexp(options.increment, -static_cast<int>(i)) * penetration,
                                    .rate_fraction = options.rate_fraction,
                                    .steps = options.steps});
    told(evaluation, "history_steps") += history.steps;
    if (!history.at_rest) {
      told(evaluation, "confirmed_by_history") = 0;
      const Status why = history.status == Status::converged ? Status::iteration_limit : history.status;
      evaluation.messages.push_back(
          fmt::format("A history in which the cases alternate came to no end ({}): what they wear off together is not "
                      "confirmed by it.",
                      to_string(why)));
      return;
    }
    volume[i] = history.worn_volume;
    depth = history.depth;
  }
  const double direct = result.mission->worn_volume, past = 2 * volume[1] - volume[0];
  const double bar = std::abs(volume[1] - volume[0]);
  const CandidateModel& model = result.models.front();
  const bool confirmed = std::abs(past - direct) <= std::max(bar, options.confirms * direct) ||
                         wear::a_node_apart(node_lines(model.cells), model.cells.area, depth, result.mission->depth);
  told(evaluation, "history_volume_m3") = past;
  told(evaluation, "history_bar_m3") = bar;
  told(evaluation, "confirmed_by_history") = confirmed ? 1 : 0;
  if (!confirmed)
    evaluation.messages.push_back(
        fmt::format("Where the cases alternate they wear off {:.4g} m^3 together, found directly {:.4g} m^3: which of "
                    "the two depends on how they follow one another.",
                    past, direct));
}

}  // namespace dovetail::optimizer
