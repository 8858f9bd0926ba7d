#include "studies/program/commands/kept_choice.hpp"

#include <fstream>

#include "core/replace_file.hpp"
#include "optimizer/journal/fingerprint.hpp"
#include "studies/program/answers/version.hpp"
#include "studies/program/engine/engine.hpp"
#include "studies/program/engine/settled_study.hpp"
#include "studies/program/study_file/best_file.hpp"

namespace dovetail::studies {

using Json = nlohmann::ordered_json;

namespace {

InputError damaged(const std::filesystem::path& file) {
  return InputError(Violation{.file = file.string(),
                              .key = "the file",
                              .value = {},
                              .allowed = "is damaged: remove it, and --resume chooses the settings again"});
}

}  // namespace

std::string question_of(const Study& study) {
  std::string text = std::string("dovetail ") + version() + "\n" + physics_text(study.scene);
  for (const std::string& key : study.given)
    if (optimizer::buys_accuracy(study.scene, key)) text += "given " + key + "\n";
  const auto accuracy_of = [&](const auto& terms) {
    for (const auto& term : terms)
      if (study.scene.solver.accuracy > 0 && term.accuracy > 0)
        text += "accuracy of " + term.response + " " + shortest(term.accuracy) + "\n";
  };
  accuracy_of(study.problem.objective);
  accuracy_of(study.problem.constraints);
  return optimizer::fingerprint(study.problem, study.optimizer, text);
}

void keep(const std::filesystem::path& file, const std::string& question, const Chosen& chosen) {
  const Json json{
      {"question", question}, {"settings", chosen.settings}, {"noise", chosen.noise}, {"accuracy", chosen.accuracy}};
  replace_file(file, json.dump(1) + "\n");
}

optimizer::BarParts raised_in(const Chosen& chosen) {
  const Json& accuracy = chosen.accuracy;
  if (!accuracy.is_object() || !accuracy.contains("raised")) return {};
  return accuracy.at("raised").get<optimizer::BarParts>();
}

std::optional<Chosen> kept(const std::filesystem::path& file, const std::string& question) {
  std::ifstream stream(file);
  if (!stream) return {};
  try {
    const Json json = Json::parse(stream);
    if (json.at("question").get<std::string>() != question) return {};
    Chosen chosen{.settings = json.at("settings").get<std::map<std::string, double>>(),
                  .noise = json.at("noise").get<double>(),
                  .accuracy = json.at("accuracy")};
    (void)raised_in(chosen);
    return chosen;
  } catch (const Json::exception&) {
    throw damaged(file);
  }
}

Study with_chosen(const Study& study, const Chosen& chosen, const std::filesystem::path& kept_in) {
  Study result = study;
  try {
    if (!chosen.settings.empty())
      result =
          read_study(parse_document(with_values(parse_document(study.text, study.file), chosen.settings), study.file));
  } catch (const InputError&) {
    throw damaged(kept_in);  // the study was read without them
  }
  result.optimizer.noise = chosen.noise;
  return result;
}

}  // namespace dovetail::studies
