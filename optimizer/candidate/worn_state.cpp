#include "optimizer/candidate/worn_state.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "optimizer/candidate/worn_zones.hpp"
#include "paths/steady_state.hpp"
#include "wear/asymptote/certificate.hpp"
#include "wear/asymptote/followed_asymptote.hpp"

namespace dovetail::optimizer {

namespace {

WornState come_to_rest(const Scene& scene, const steady::Joint& joint, const steady::State& unworn,
                       const char* arbitration) {
  wear::AsymptoteOptions options;
  options.arbitration = arbitration;
  options.certify_finer = false;  // more harmonics and samples have their bars
  if (scene.loading.follow != "resonance")
    return {.asymptote = wear::asymptote(joint, unworn.omega, options, &unworn),
            .held = {},
            .omega = unworn.omega,
            .unfinished = {}};
  wear::FollowedAsymptote found = wear::followed_asymptote(joint, unworn.omega, options, {}, &unworn);
  return {.asymptote = std::move(found.asymptote),
          .held = std::move(found.held),
          .omega = found.omegas.back(),
          .unfinished = {}};
}

wear::OtherState other_state(wear::FoundBy found_by, wear::Asymptote found) {
  return {.found_by = found_by,
          .depth = std::move(found.depth),
          .worn_volume = found.worn_volume,
          .largest_depth = found.largest_depth};
}

/// Where the wear history ends with twice the harmonics plus one and twice the samples; nothing where it comes to no
/// end. Which nodes lift off first may hang on harmonics and samples: then histories of neighbouring designs and meshes
/// end far from one another, and more of both tell where wear goes.
std::optional<wear::OtherState> finer_history(Scene scene, const CandidateModel& model, steady::Joint joint,
                                              const steady::State& unworn) {
  joint.options = wear::finer_settings(joint.options);
  scene.solver.harmonics = joint.options.harmonics;
  scene.solver.samples = joint.options.samples;
  joint.options.budget = new_budget(scene.solver, model);
  const steady::State start =
      paths::steady_state(joint, unworn.omega, paths::padded(unworn.displacement, joint.options.harmonics));
  if (start.status != Status::converged) return {};
  wear::Asymptote found = come_to_rest(scene, joint, start, "always").asymptote;
  if (found.verdict != wear::Verdict::asymptote || !found.confirmed_by_history) return {};
  return other_state(wear::FoundBy::finer_history, std::move(found));
}

/// Where history and direct method end, and where a finer history does if they are far apart.
struct Ends {
  bool direct_stays = false;
  std::optional<wear::OtherState> finer;
  std::string unfinished;  ///< what to say where the finer history was asked and came to no end
};

Ends compared(const Scene& scene, const CandidateModel& model, const steady::Joint& joint, const steady::State& unworn,
              const wear::Asymptote& history, const wear::Asymptote& direct) {
  if (!far_apart(model.cells, history.depth, direct.depth))
    return {.direct_stays = a_node_apart(model.cells, history.depth, direct.depth), .finer = {}, .unfinished = {}};
  Ends ends{.direct_stays = false, .finer = finer_history(scene, model, joint, unworn), .unfinished = {}};
  if (!ends.finer)
    ends.unfinished = "one with more harmonics and samples came to no end";
  else
    ends.direct_stays = std::abs(ends.finer->worn_volume - direct.worn_volume) <
                        std::abs(ends.finer->worn_volume - history.worn_volume);
  return ends;
}

/// Looks for doubt in a worn state that was found directly and asks the wear history.
void settle(const Scene& scene, const CandidateModel& model, steady::Joint joint, const steady::State& unworn,
            WornState& worn) {
  joint.options.budget = new_budget(scene.solver, model);
  WornState asked = come_to_rest(scene, joint, unworn, "auto");
  wear::Asymptote &found = asked.asymptote, &direct = worn.asymptote;
  const std::string unfinished = spent(joint.options.budget)
                                     ? "it spent its budget (solver.max_jacobians, solver.time_limit_s)"
                                     : "it came to no end";
  if (found.verdict == wear::Verdict::not_converged) {
    direct.doubt = found.doubt == wear::Doubt::none ? wear::Doubt::unfinished : found.doubt;
    worn.unfinished = unfinished;
    return;
  }
  Ends ends;
  if (found.decided_by == wear::FoundBy::history && direct.decided_by == wear::FoundBy::release &&
      found.verdict == wear::Verdict::asymptote)
    ends = compared(scene, model, joint, unworn, found, direct);
  if (ends.direct_stays) {
    direct.doubt = found.doubt;
    direct.confirmed_by_history = true;
    direct.other_states = {other_state(wear::FoundBy::history, std::move(found))};
  } else {
    worn = std::move(asked);
    const bool undecided = worn.asymptote.doubt != wear::Doubt::none && !worn.asymptote.confirmed_by_history;
    worn.unfinished = undecided ? unfinished : ends.unfinished;
  }
  if (ends.finer) worn.asymptote.other_states.push_back(std::move(*ends.finer));
}

}  // namespace

WornState worn_state(const Scene& scene, const CandidateModel& model, const steady::Joint& joint,
                     const steady::State& unworn, bool history) {
  WornState worn = come_to_rest(scene, joint, unworn, "unsettled");
  if (history && worn.asymptote.verdict == wear::Verdict::asymptote) settle(scene, model, joint, unworn, worn);
  return worn;
}

void note_doubt(const wear::Asymptote& asymptote, const std::string& unfinished, Evaluation& evaluation) {
  const bool by_history = asymptote.decided_by == wear::FoundBy::history;
  evaluation.model["wear_history_may_differ"] =
      asymptote.doubt == wear::Doubt::none || asymptote.confirmed_by_history ? 0 : 1;
  evaluation.model["wear_decided_by_history"] = by_history ? 1 : 0;
  if (asymptote.doubt == wear::Doubt::none) return;
  const auto found = [&asymptote](wear::FoundBy by) {
    const auto at = std::find_if(asymptote.other_states.begin(), asymptote.other_states.end(),
                                 [by](const wear::OtherState& other) { return other.found_by == by; });
    return at == asymptote.other_states.end() ? nullptr : &*at;
  };
  const wear::OtherState *direct = found(wear::FoundBy::release), *history = found(wear::FoundBy::history),
                         *finer = found(wear::FoundBy::finer_history);
  const auto volume = [](double value) { return fmt::format("{:.4g} m^3", value); };
  std::string outcome;
  if (by_history && direct != nullptr) {
    outcome = "the wear history decided and ends with " + volume(asymptote.worn_volume) + ", the direct method with " +
              volume(direct->worn_volume);
    if (finer != nullptr)
      outcome +=
          ", and a history with more harmonics and samples, nearer to the first, with " + volume(finer->worn_volume);
    else if (!unfinished.empty())
      outcome += "; " + unfinished;
  } else if (by_history) {
    outcome = "the wear history decided";
  } else if (history != nullptr && finer != nullptr) {
    outcome = "the wear history ends with " + volume(history->worn_volume) +
              ", but with more harmonics and samples nearer to the direct answer, with " + volume(finer->worn_volume);
  } else if (history != nullptr) {
    outcome =
        "the wear history, which wears off whole nodes, ends within one of it, with " + volume(history->worn_volume);
  } else if (asymptote.confirmed_by_history) {
    outcome = "the wear history ends in it, too";
  } else {
    outcome = "no wear history has decided" + (unfinished.empty() ? "" : ": " + unfinished);
  }
  evaluation.messages.push_back(fmt::format("The worn state was in doubt ({}: {}): {}.", to_string(asymptote.doubt),
                                            entry(asymptote.doubt).meaning, outcome));
}

}  // namespace dovetail::optimizer
