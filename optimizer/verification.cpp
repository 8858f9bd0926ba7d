#include "optimizer/verification.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "optimizer/candidate/stopwatch.hpp"
#include "optimizer/responses/computed.hpp"
#include "optimizer/responses/response_table.hpp"
#include "quality/truncation.hpp"
#include "wear/history/history.hpp"
#include "wear/measures.hpp"

namespace dovetail::optimizer {

namespace {

/// Depths of the cells of a fine grid at the middles of a coarser one's.
Eigen::VectorXd on_grid(const Eigen::VectorXd& depth, const fem::ContactCells& from, const fem::ContactCells& to) {
  Eigen::VectorXd result = Eigen::VectorXd::Zero(to.count());
  for (Eigen::Index i = 0; i < to.count(); ++i) {
    double nearest = std::numeric_limits<double>::infinity();
    for (Eigen::Index k = 0; k < from.count(); ++k) {
      if (from.flank(k) != to.flank(i)) continue;
      const double distance = (from.position.col(k) - to.position.col(i)).norm();
      if (distance < nearest) {
        nearest = distance;
        result(i) = depth(k);
      }
    }
  }
  return result;
}

/// Two histories, the second with half the increment, and what they extrapolate to.
std::string wear_down(const Scene& scene, const CandidateResult& result, const VerificationOptions& options,
                      const wear::Watcher& watcher, Verification& verification) {
  const std::shared_ptr<const dynamics::CondensedModel>& model = result.model.condensed;
  steady::Options steady = steady_options(scene.solver);
  std::array<double, 2> volume{};
  std::array<Eigen::VectorXd, 2> depth;
  for (const std::size_t i : {0, 1}) {
    steady.budget = new_budget(scene.solver, result.model, options.budgets);
    wear::HistoryOptions settings;
    settings.follow = scene.loading.follow;
    settings.increment =
        std::ldexp(options.increment, -static_cast<int>(i)) * wear::largest_penetration(*model, result.unworn->state);
    settings.steps = options.steps;
    settings.finish = false;
    const wear::History history =
        wear::history({model, {}, steady}, {.omega = result.unworn->omega}, settings, watcher);
    verification.history_solves += history.solves;
    if (history.end != wear::HistoryEnd::worn_out)
      return failed_at("history", history.end == wear::HistoryEnd::failed ? to_string(history.status)
                                                                          : wear::to_string(history.end));
    const Eigen::Index last = history.cycles.size() - 1;
    verification.cycles = history.cycles(last);
    volume[i] = history.worn_volume(last);
    depth[i] = history.depth.row(last).transpose();
  }
  verification.history_volume = 2 * volume[1] - volume[0];
  verification.history_bar = std::abs(volume[1] - volume[0]);
  verification.history_profile = (2 * depth[1] - depth[0]).cwiseMax(0.0);
  verification.history_depth = verification.history_profile.maxCoeff();
  verification.profile_difference =
      (verification.history_profile - verification.search_profile).cwiseAbs().maxCoeff() / verification.search_depth;
  return status_of(Outcome::converged);
}

/// Where an answer lies farther from the search's than it may.
std::string apart(const Verification& v, const char* what, double volume, double bars) {
  if (std::abs(volume - v.search_volume) <= bars) return status_of(Outcome::converged);
  return fmt::format("{}: search {:.4g} m^3, {} {:.4g} m^3, bars {:.2g} m^3", to_string(Outcome::disagrees),
                     v.search_volume, what, volume, bars);
}

/// What designs or cases share approximately is looked at, too; and one design alone is cheaper with its own.
Scene with_own_prestress(Scene scene) {
  scene.solver.prestress = Prestress::own;
  return scene;
}

/// The direct answer at finer settings.
std::string ask_finer(const FinerDesign& there, const CandidateResult& result, Verification& verification) {
  const Scene scene = with_own_prestress(there.scene);
  const CandidateResult fine =
      computed(scene, ModelBuilder(there.reference).build(scene), until(kSearch.until, kSearch.history));
  if (!fine.evaluation.converged()) return failed_at("finer mesh", fine.evaluation.status);
  verification.direct_solves = fine.asymptote->solves;
  verification.direct_volume = fine.asymptote->worn_volume;
  verification.direct_depth = fine.asymptote->largest_depth;
  verification.direct_profile = on_grid(fine.asymptote->depth, fine.model.cells, result.model.cells);
  return status_of(Outcome::converged);
}

}  // namespace

Scene finer(Scene scene, int level) {
  const auto raise = [&scene](const char* key, double value) {
    set_parameter(scene, key, std::min(value, find_parameter(key)->range.upper));
  };
  raise("mesh.flank_elements", std::ldexp(scene.mesh.flank_elements, level));
  raise("solver.harmonics", 2 * scene.solver.harmonics + 1);
  raise("solver.samples", quality::samples_for(scene.solver.harmonics, 2 * scene.solver.samples));
  return with_own_prestress(std::move(scene));
}

CandidateResult evaluated_finer(const SceneEvaluator& evaluator, const Scene& scene, const Purpose& purpose,
                                int level) {
  const Scene fine = finer(scene, level);
  return computed(fine, ModelBuilder(finer(evaluator.reference(), level)).build(fine),
                  until(purpose.until, purpose.history));
}

Evaluation mission_finer(const SceneEvaluator& evaluator, MissionLoads loads, int level) {
  for (MissionLoads::Load& load : loads.all) load.scene = finer(std::move(load.scene), level);
  return SceneEvaluator(finer(evaluator.reference(), level)).evaluate_mission(loads, kSearch);
}

FinerDesign twice_as_fine(const SceneEvaluator& evaluator, const Scene& scene) {
  return {.scene = finer(scene, 1), .reference = finer(evaluator.reference(), 1)};
}

Verification verify(const SceneEvaluator& evaluator, const Scene& scene, const VerificationOptions& options,
                    const wear::Watcher& watcher) {
  return verify(scene, evaluator.evaluate(scene), twice_as_fine(evaluator, scene), options, watcher);
}

Verification verify(const Scene& scene, const CandidateResult& result, const FinerDesign& there,
                    const VerificationOptions& options, const wear::Watcher& watcher) {
  Stopwatch watch;
  Verification verification;
  verification.follow = scene.loading.follow;
  verification.flank_elements = there.scene.mesh.flank_elements;
  verification.harmonics = there.scene.solver.harmonics;
  verification.samples = there.scene.solver.samples;
  if (!result.evaluation.converged()) {
    verification.status = result.evaluation.status;
  } else {
    verification.search_volume = result.asymptote->worn_volume;
    verification.search_depth = result.asymptote->largest_depth;
    verification.search_profile = result.asymptote->depth;
    const auto bar = result.evaluation.error_estimates.find(std::string(kWornVolume.name));
    const double search_bar = bar == result.evaluation.error_estimates.end() ? std::nan("") : bar->second;
    verification.search_bar = search_bar;
    verification.frequency_hz = hertz(result.unworn->omega);
    std::string finer = ask_finer(there, result, verification), history = status_of(Outcome::converged);
    if (converged(finer)) finer = apart(verification, "finer mesh", verification.direct_volume, search_bar);
    if (verification.search_depth > 0)
      history = wear_down(scene, result, options, watcher, verification);
    else  // where every node sticks a history would not leave its first state
      verification.history_profile = verification.search_profile;
    if (converged(history))
      history = apart(verification, "history", verification.history_volume,
                      options.of_bar * search_bar + verification.history_bar);
    const bool by_history =
        converged(finer) || (outcome_of(history) == Outcome::disagrees && outcome_of(finer) != Outcome::disagrees);
    verification.status = by_history ? history : finer;
  }
  if (watcher.stopped()) verification.status = status_of(Outcome::interrupted);
  verification.seconds = watch.lap();
  return verification;
}

}  // namespace dovetail::optimizer
