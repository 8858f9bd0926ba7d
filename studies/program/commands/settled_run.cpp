#include "studies/program/commands/settled_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <ostream>

#include "core/replace_file.hpp"
#include "optimizer/journal/fingerprint.hpp"
#include "studies/program/answers/accuracy_json.hpp"
#include "studies/program/answers/version.hpp"
#include "studies/program/engine/settled_study.hpp"
#include "studies/program/study_file/best_file.hpp"

namespace dovetail::studies {

namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kFile = "settings.json";

/// What the bars of the start say of differences between designs. No history is asked in a search: a doubt that only
/// one settles is no noise.
double noise_of(const Study& study, const optimizer::Evaluation& start) {
  std::map<std::string, double> bars;
  for (const auto& [response, sources] : start.error_sources)
    for (const auto& [source, bar] : sources)
      if (source != "history") bars[response] += bar;
  const double objective = judge(study.problem, start, study.optimizer.constraint_tolerance).objective;
  const double bar = judgement_bars(study.problem, bars).objective;
  if (!std::isfinite(objective) || !std::isfinite(bar) || objective == 0) return optimizer::NoiseParams{}.unknown_bar;
  return std::clamp(bar / std::abs(objective), optimizer::NoiseParams{}.unknown, 0.5);
}

/// What was chosen before for the same question; null otherwise.
Json kept(const std::filesystem::path& file, const std::string& question) {
  std::ifstream stream(file);
  const Json json = Json::parse(stream, nullptr, false);
  return json.is_object() && json.value("question", "") == question ? json : Json();
}

/// @return "question", "settings", "noise" and "accuracy"
Json chosen(const Study& asked, const std::string& question, const RunEngineFactory& make_engine, std::ostream& err) {
  Json json{{"question", question}, {"settings", Json::object()}, {"noise", asked.optimizer.noise}, {"accuracy", {}}};
  Study study = asked;
  const std::optional<optimizer::SettingsChoice> choice = settle(
      study, [&](const optimizer::SettingsTried& tried) { err << "dovetail: " << round_words(asked, tried) << "\n"; });
  if (choice) {
    for (const auto& [key, value] : settings_by_key(asked.scene, choice->settings))
      if (!asked.given.contains(key)) json["settings"][key] = value;
    json["accuracy"] = accuracy_json(asked.scene, *choice);
    if (const std::string open = accuracy_complaint(*choice); !open.empty()) err << "dovetail: " << open << "\n";
  }
  if (asked.optimizer.noise == 0) {
    const RunEngine engine = choice && choice->tried.by ? RunEngine{} : make_engine(study);
    if (engine.start)
      json["noise"] = noise_of(study, engine.start());
    else if (choice)
      json["noise"] = noise_of(study, choice->evaluation);
    else
      return json;
    err << fmt::format("dovetail: noise of the objective, from its error bar at the start: {:.2g}\n",
                       json["noise"].get<double>());
  }
  return json;
}

}  // namespace

Study settled_run(Study study, const std::filesystem::path& directory, bool resume, const RunEngineFactory& make_engine,
                  std::ostream& err) {
  if (study.scene.solver.accuracy == 0 && study.optimizer.noise > 0) return study;
  const std::string question = optimizer::fingerprint(
      study.problem, study.optimizer, std::string("dovetail ") + version() + "\n" + physics_text(study.scene));
  const std::filesystem::path file = directory / kFile;
  Json json = resume ? kept(file, question) : Json();
  if (json.is_null()) {
    json = chosen(study, question, make_engine, err);
    replace_file(file, json.dump(1) + "\n");
  }
  const auto settings = json.at("settings").get<std::map<std::string, double>>();
  if (!settings.empty())
    study = read_study(parse_document(with_values(parse_document(study.text, study.file), settings), study.file));
  study.optimizer.noise = json.at("noise").get<double>();
  return study;
}

}  // namespace dovetail::studies
