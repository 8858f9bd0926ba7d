#include "studies/program/commands/settled_run.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>
#include <ostream>

#include "optimizer/evaluation_cost.hpp"
#include "optimizer/journal/fingerprint.hpp"
#include "optimizer/responses/response_table.hpp"
#include "optimizer/scene/scene_kind.hpp"
#include "studies/program/answers/accuracy_json.hpp"
#include "studies/program/commands/kept_choice.hpp"
#include "studies/program/commands/kept_rounds.hpp"
#include "studies/program/engine/engine.hpp"
#include "studies/program/engine/settled_study.hpp"
#include "studies/program/run/run_output.hpp"

namespace dovetail::studies {

namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kFile = "settings.json";
/// Designs at which settings are chosen.
constexpr const char *kStart = "the start", *kMiddle = "the middle of the variables' ranges",
                     *kBest = "the best design";
constexpr const char* kBestFile = "best_settings.json";
/// The rounds of a choice that is not made yet.
constexpr const char *kRounds = "settings_rounds.jsonl", *kBestRounds = "best_settings_rounds.jsonl";

/// What the bars of the start, in the first case, say of differences between designs. No history is asked in a search:
/// a doubt that only one settles is no noise. What all cases wear off together is taken to be as noisy as what the
/// first one does: the same computation, whose bars are there. Of a front the noisiest objective counts: each is
/// limited while others are minimised, and a step that is lost in the noise of one of them tells nothing. Nothing where
/// the bars say nothing.
std::optional<double> noise_of(const Study& study, const optimizer::Evaluation& start) {
  optimizer::Problem alone = study.problem;
  alone.cases.clear();
  for (optimizer::ObjectiveTerm& term : alone.objective) {
    // How far cases scatter one of them does not tell.
    if (term.over == to_string(optimizer::Over::deviation)) return {};
    const optimizer::Response* response = optimizer::find_response(term.response);
    if (response != nullptr && response->alone != nullptr) term.response = response->alone->name;
    if (std::ranges::find(start.unbounded, term.response) != start.unbounded.end()) return {};
  }
  std::map<std::string, double> bars;
  for (const auto& [response, sources] : start.error_sources)
    for (const auto& [source, bar] : sources)
      if (source != "history") bars[response] += bar;
  std::vector<double> sizes, noises;
  for (const optimizer::ObjectiveTerm& term : alone.objective) {
    const auto [value, bar] = term_value(alone, term, start.responses, bars);
    sizes.push_back(value);
    noises.push_back(bar);
  }
  if (!alone.front) {
    sizes = {std::accumulate(sizes.begin(), sizes.end(), 0.0)};
    noises = {std::accumulate(noises.begin(), noises.end(), 0.0)};
  }
  double noise = optimizer::NoiseParams{}.unknown;
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    if (!std::isfinite(sizes[i]) || !std::isfinite(noises[i]) || sizes[i] == 0) return {};
    noise = std::max(noise, noises[i] / std::abs(sizes[i]));
  }
  return std::min(noise, 0.5);
}

/// Settings for the accuracy that the study asks for at its own design, which is `where`; nothing where it asks for
/// none.
/// @param many  many designs are computed at those settings
/// @param stop  set: the choice ends after the round at hand
std::optional<optimizer::SettingsChoice> choose(const Study& there, const char* where, bool many,
                                                const optimizer::AccuracyMemory& rounds, const std::atomic<bool>* stop,
                                                Teller& teller, Chosen& result) {
  Study settled = there;
  if (there.scene.solver.accuracy > 0) teller.begin(std::string("choosing settings at ") + where);
  const auto stopped = [stop] { return stop != nullptr && stop->load(); };
  std::optional<optimizer::AccuracyGoal> goal = accuracy_goal(settled);
  if (goal) goal->many = many;
  const auto tell = [&](const optimizer::SettingsTried& tried) {
    teller.remark() << "dovetail: " << round_words(there, tried) << "\n";
    return !stopped();
  };
  std::optional<optimizer::SettingsChoice> choice = settle(settled, goal, tell, rounds);
  if (!choice || stopped()) return choice;
  for (const auto& [key, value] : settings_by_key(there.scene, choice->settings))
    if (!there.given.contains(key)) result.settings[key] = value;
  result.accuracy = accuracy_json(there.scene, *choice);
  result.accuracy["at"] = where;
  for (const std::string& words :
       {taken_words(there, *choice), accuracy_complaint(there, *choice), digit_words(*choice)})
    if (!words.empty()) teller.remark() << "dovetail: " << words << "\n";
  return choice;
}

/// The study that asks for the accuracy of what is handed over, and of single responses for none that is coarser.
Study verified(Study study) {
  const bool of_search = study.scene.solver.accuracy > 0;
  study.scene.solver.accuracy = study.optimizer.verify_accuracy;
  if (!of_search) return study;
  const auto refine = [&](auto& terms) {
    for (auto& term : terms)
      if (term.accuracy > study.optimizer.verify_accuracy) term.accuracy = 0;
  };
  refine(study.problem.objective);
  refine(study.problem.constraints);
  return study;
}

Chosen chosen(const Study& asked, KeptRounds& rounds, const RunEngineFactory& make_engine, Teller& teller) {
  Chosen result{.settings = {}, .noise = asked.optimizer.noise};
  Study at_start = asked;
  at_start.scene = start_scene(asked);
  const char* where = kStart;
  std::optional<optimizer::SettingsChoice> choice =
      choose(at_start, where, true, rounds.at(0), nullptr, teller, result);
  if (choice && !choice->tried.by && asked.problem.space.size() > 0) {
    where = kMiddle;
    teller.remark() << "dovetail: settings from " << where << " instead\n";
    at_start.scene = reference_scene(asked);
    choice = choose(at_start, where, true, rounds.at(1), nullptr, teller, result);
    if (!choice->tried.by) where = kStart;
  }
  if (asked.optimizer.noise > 0) return result;
  const RunEngine engine = choice && choice->tried.by ? RunEngine{} : make_engine(asked);
  if (!engine.start && !choice) return result;
  if (engine.start) {
    const optimizer::Cost cost = expected_cost(at_start);
    teller.begin("computing the start with its error bars",
                 cost.seconds * optimizer::work_foreseen(asked.scene.kind->in_space).bars);
  }
  const std::optional<double> noise = noise_of(asked, engine.start ? engine.start() : choice->evaluation);
  result.noise = noise.value_or(optimizer::NoiseParams{}.unknown_bar);
  teller.remark() << fmt::format("dovetail: noise of the objective{}{}: {:.2g}\n",
                                 noise ? ", from its error bar at " : ", which has no error bar at ", where,
                                 result.noise);
  return result;
}

/// What an accuracy asked for came to, of what accuracy_json says of it.
std::string came_to(const Json& accuracy) {
  if (!accuracy.is_object() || !accuracy.contains("response") || !accuracy.at("response").is_string())
    return "no bar says what is reached";
  const std::string where = accuracy.value("at", kStart), response = accuracy.at("response").get<std::string>();
  if (!accuracy.at("relative_bar").is_number())
    return fmt::format("at {} not reached: no mesh tried resolves {}", where, response);
  const bool reached = accuracy.at("status") == to_string(Status::converged);
  const double bought = accuracy.at("relative_bar").get<double>();
  const double whole = accuracy.value("relative_bar_total", bought);
  std::string text = fmt::format("at {} {}: {} to {:.3g} %", where,
                                 reached ? "reached as far as settings buy it" : "not reached", response, 100 * bought);
  if (whole > kTellWhole * bought) text += fmt::format(", {:.3g} % with what they do not buy", 100 * whole);
  if (accuracy.contains("not_held"))
    for (const Json& name : accuracy.at("not_held")) text += ", " + name.get<std::string>() + " held to none";
  return text;
}

}  // namespace

void refuse_changed(const std::filesystem::path& directory, const Study& study) {
  const std::filesystem::path kept = directory / "study.toml";
  if (!std::filesystem::exists(kept)) return;
  std::vector<std::string> changed =
      changed_values(load_document(kept.string()), parse_document(study.text, study.file));
  // What an accuracy chose stands in the study that was kept.
  if (study.scene.solver.accuracy > 0)
    std::erase_if(changed, [](const std::string& one) {
      return (one.starts_with("mesh.") || one.starts_with("solver.")) && one.find(" missing (") != one.npos;
    });
  std::erase_if(changed, [](const std::string& one) {
    constexpr std::string_view kTable = "optimizer.";
    return one.starts_with(kTable) && optimizer::may_change(one.substr(kTable.size(), one.find(' ') - kTable.size()));
  });
  if (changed.empty()) return;
  constexpr std::size_t kTold = 6;
  if (const std::size_t all = changed.size(); all > kTold) {
    changed.resize(kTold);
    changed.push_back(fmt::format("{} more", all - kTold));
  }
  throw InputError(Violation{
      .file = directory.string(),
      .key = "--resume",
      .value = {},
      .allowed = fmt::format("the run there is of another study than the one at hand: {}; give the same --set as then, "
                             "resume {} as it is kept, or choose another directory",
                             fmt::join(changed, ", "), kept.string())});
}

void refuse_fewer(const std::filesystem::path& directory, const Study& study, std::size_t kept) {
  const std::filesystem::path before = directory / "study.toml";
  const int asked = study.optimizer.max_evaluations;
  if (kept <= static_cast<std::size_t>(asked) || !std::filesystem::exists(before)) return;
  const Document document = load_document(before.string());
  const Node* then = document.root.at("optimizer.max_evaluations");
  const int had = then != nullptr && then->is_number() ? static_cast<int>(then->real)
                                                       : optimizer::OptimizerOptions{}.max_evaluations;
  if (had <= asked) return;
  throw InputError(Violation{
      .file = directory.string(),
      .key = "optimizer.max_evaluations",
      .value = std::to_string(asked),
      .allowed = fmt::format("must be >= {}, the evaluations that are kept there: with fewer the answer would "
                             "become worse; of a run that shall end now give that number",
                             kept)});
}

SettledStudy settled_run(const Study& asked, const std::filesystem::path& directory, bool resume,
                         const RunEngineFactory& make_engine, Teller& teller) {
  const bool chooses = asked.scene.solver.accuracy > 0;
  if (!chooses && asked.optimizer.noise > 0) return {.study = asked};
  const std::string question = question_of(asked);
  const std::filesystem::path file = directory / kFile;
  std::optional<Chosen> settled = resume ? kept(file, question) : std::nullopt;
  if (!settled && resume && std::filesystem::exists(file) && std::filesystem::exists(directory / "journal.jsonl")) {
    refuse_changed(directory, asked);
    throw InputError(Violation{.file = file.string(),
                               .key = "the choice in it",
                               .value = {},
                               .allowed = "was made for another study, accuracy or accuracy_work than the one at "
                                          "hand: resume that one, or begin anew without --resume"});
  }
  if (!settled) {
    KeptRounds rounds(directory / kRounds, question);
    settled = chosen(asked, rounds, make_engine, teller);
    keep(file, question, *settled);
    rounds.forget();
  }
  const bool at_start = chooses && settled->accuracy.is_object() && settled->accuracy.value("at", kStart) == kStart;
  return {.study = with_chosen(asked, *settled, file),
          .accuracy = chooses ? came_to(settled->accuracy) : "",
          .raised = at_start ? raised_in(*settled) : optimizer::BarParts()};
}

std::optional<optimizer::AccuracyGoal> goal_at_best(const Study& asked) {
  return accuracy_goal(asked.optimizer.verify_accuracy > 0 ? verified(asked) : asked);
}

std::map<std::string, std::string> chosen_settings(const Study& asked, const SettledStudy& searched,
                                                   const SettledStudy& handed) {
  std::map<std::string, std::string> result;
  const auto add = [&](const char* key, double accuracy, const SettledStudy& settled) {
    if (!settled.accuracy.empty()) result[key] = fmt::format("{:g}, {}", accuracy, settled.accuracy);
  };
  add("solver.accuracy", asked.scene.solver.accuracy, searched);
  add("optimizer.verify_accuracy", asked.optimizer.verify_accuracy, handed);
  if (result.empty()) return result;
  const auto values = [](const SettledStudy& settled) {
    return settings_by_key(settled.study.scene, settings_of(settled.study.scene));
  };
  const auto by_search = values(searched), at_end = values(handed);
  for (const auto& [key, value] : by_search) {
    if (asked.given.contains(key)) continue;
    result[key] = fmt::format("{:g}", value);
    if (at_end.at(key) != value) result[key] += fmt::format(", handed over with {:g}", at_end.at(key));
  }
  return result;
}

SettledStudy settled_best(const Study& asked, const Study& searched, const optimizer::Candidate& best,
                          const std::filesystem::path& directory, bool resume, const OrderlyInterrupt& interrupt,
                          Teller& teller) {
  if (asked.optimizer.verify_accuracy == 0) return {.study = searched};
  Study there = searched;
  there.given = asked.given;
  there.scene = scene_of(searched, best);
  std::string question = question_of(verified(there)) + shortest(asked.optimizer.verify_accuracy);
  const std::filesystem::path file = directory / kBestFile;
  std::optional<Chosen> settled = resume ? kept(file, question) : std::nullopt;
  if (!settled) {
    teller.remark() << "dovetail: settings for the best design\n";
    settled = Chosen{.settings = {}, .noise = searched.optimizer.noise};
    KeptRounds rounds(directory / kBestRounds, question);
    choose(verified(there), kBest, false, rounds.at(0), &interrupt.flag(), teller, *settled);
    if (interrupt.requested()) return {.study = searched};
    keep(file, question, *settled);
    rounds.forget();
  }
  return {.study = with_chosen(searched, *settled, file),
          .accuracy = came_to(settled->accuracy),
          .raised = raised_in(*settled)};
}

}  // namespace dovetail::studies
