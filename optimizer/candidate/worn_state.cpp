#include "optimizer/candidate/worn_state.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "optimizer/candidate/node_lines.hpp"

namespace dovetail::optimizer {

namespace {

std::string words(wear::Unfinished unfinished) {
  switch (unfinished) {
    case wear::Unfinished::none:
      return "";
    case wear::Unfinished::history:
      return "it came to no end";
    case wear::Unfinished::history_budget:
      return "it spent its budget (solver.max_jacobians, solver.time_limit_s)";
    case wear::Unfinished::finer_history:
      return "one with more harmonics and samples came to no end";
  }
  return "";
}

}  // namespace

wear::Rest worn_state(const Scene& scene, const CandidateModel& model, const steady::Joint& joint,
                      const steady::State& unworn, bool history) {
  wear::RestOptions options;
  options.follow = scene.loading.follow == wear::Follow::resonance;
  options.history = history;
  options.lines = node_lines(model.cells);
  options.asymptote.history_tolerance = scene.solver.history_tolerance;
  options.asymptote.history_budget = [&](const steady::Options& settings) {
    SolverSettings solver = scene.solver;
    solver.harmonics = settings.harmonics;
    solver.samples = settings.samples;
    return new_budget(solver, model);
  };
  options.asymptote.certify_finer = false;  // more harmonics and samples have their bars
  return wear::comes_to_rest(joint, unworn.omega, options, &unworn);
}

void note_doubt(const wear::Asymptote& asymptote, wear::Unfinished unfinished, Evaluation& evaluation) {
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
    else if (unfinished != wear::Unfinished::none)
      outcome += "; " + words(unfinished);
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
    outcome = "no wear history has decided" + (unfinished == wear::Unfinished::none ? "" : ": " + words(unfinished));
  }
  evaluation.messages.push_back(fmt::format("The worn state was in doubt ({}: {}): {}.", to_string(asymptote.doubt),
                                            entry(asymptote.doubt).meaning, outcome));
}

}  // namespace dovetail::optimizer
