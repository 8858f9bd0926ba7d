#include "optimizer/verification.hpp"

#include <cmath>
#include <numbers>
#include <utility>

#include "optimizer/stopwatch.hpp"
#include "wear/follow.hpp"
#include "wear/history.hpp"

namespace dovetail::optimizer {

namespace {

std::string failure(const std::string& stage, std::string_view why) {
  return stage + ": " + std::string(why);
}

std::string compare(const Scene& scene, const CandidateResult& result, const VerificationOptions& options,
                    const wear::Control& control, Verification& verification) {
  const std::shared_ptr<const response::CondensedModel>& model = result.model.condensed;
  response::SteadyOptions finer = steady_options(scene.solver);
  verification.harmonics = finer.harmonics = 2 * finer.harmonics + 1;
  verification.samples = finer.samples = 2 * finer.samples;
  const response::Resonance unworn = response::resonance(model, result.unworn->omega, {}, finer);
  if (unworn.status != Status::converged) return failure("unworn_resonance", to_string(unworn.status));
  verification.frequency_hz = unworn.omega / (2 * std::numbers::pi);

  wear::Asymptote direct;
  if (scene.loading.follow == "resonance") {
    wear::FollowedAsymptote found =
        wear::followed_asymptote(model, unworn.omega, {}, finer, asymptote_options(), {}, &unworn.state, control);
    direct = std::move(found.asymptote);
    direct.solves = found.solves;
  } else {
    direct = wear::asymptote(model, unworn.omega, {}, finer, asymptote_options(), &unworn.state, control);
  }
  verification.direct_solves = direct.solves;
  if (direct.verdict != wear::Verdict::asymptote)
    return failure("asymptote", direct.verdict == wear::Verdict::not_converged ? to_string(direct.status)
                                                                               : wear::to_string(direct.verdict));
  verification.direct_volume = direct.worn_volume;
  verification.direct_depth = direct.largest_depth;
  verification.direct_profile = direct.depth;
  if (!(direct.largest_depth > 0)) {
    verification.history_profile = direct.depth;
    return "converged";  // every node sticks: a history would not leave its first state
  }

  wear::HistoryOptions settings;
  settings.follow = scene.loading.follow;
  settings.increment = direct.largest_depth / options.steps;
  settings.steps = 3 * options.steps;
  const wear::History history = wear::history(model, unworn.omega, {}, finer, settings, {}, control);
  verification.history_solves = history.solves;
  const Eigen::Index last = history.cycles.size() - 1;
  if (last < 0) return failure("history", to_string(history.status));
  verification.cycles = history.cycles(last);
  verification.history_volume = history.final_volume;
  verification.history_profile = history.final_depth;
  verification.history_depth = verification.history_profile.maxCoeff();
  verification.profile_difference =
      (verification.history_profile - direct.depth).cwiseAbs().maxCoeff() / direct.largest_depth;
  if (history.end != wear::HistoryEnd::worn_out)
    return failure("history",
                   history.end == wear::HistoryEnd::failed ? to_string(history.status) : wear::to_string(history.end));
  return "converged";
}

}  // namespace

Verification verify(const SceneEvaluator& evaluator, const Scene& scene, const VerificationOptions& options,
                    const wear::Control& control) {
  Stopwatch watch;
  Verification verification;
  verification.follow = scene.loading.follow;
  CandidateResult result = evaluator.evaluate(scene);
  if (!result.unworn || !result.asymptote || !result.evaluation.converged()) {
    verification.status = result.evaluation.status;
  } else {
    verification.search_volume = result.asymptote->worn_volume;
    verification.search_depth = result.asymptote->largest_depth;
    verification.search_profile = result.asymptote->depth;
    const auto bar = result.evaluation.error_estimates.find("asymptotic_wear_volume_m3");
    verification.search_bar = bar == result.evaluation.error_estimates.end() ? std::nan("") : bar->second;
    verification.status = compare(scene, result, options, control, verification);
  }
  if (control.stopped()) verification.status = "interrupted";
  verification.model = std::move(result.model);
  verification.seconds = watch.lap();
  return verification;
}

}  // namespace dovetail::optimizer
