#include "studies/program/answers/json.hpp"

#include <string_view>

#include "optimizer/journal/evaluation_json.hpp"
#include "optimizer/journal/record_json.hpp"
#include "optimizer/mission/mission_result.hpp"
#include "optimizer/problem/load_case.hpp"
#include "optimizer/problem/problem.hpp"
#include "studies/program/answers/version.hpp"
#include "studies/program/engine/json_values.hpp"

namespace dovetail::studies {

namespace {

/// What an evaluation has of each case under its own name.
void take_cases_out(Json& json) {
  Json cases = Json::object();
  for (const char* field : {"responses", "error_estimates", "error_sources", "model", "timings_s"}) {
    Json alone = Json::object();
    for (const auto& [key, value] : json.at(field).items()) {
      const auto [name, load_case] = optimizer::split_case(key);
      (load_case.empty() ? alone : cases[std::string(load_case)][field])[std::string(name)] = value;
    }
    json[field] = std::move(alone);
  }
  Json unbounded = Json::array();
  for (const Json& name : json.at("unbounded")) {
    const auto [response, load_case] = optimizer::split_case(name.get_ref<const std::string&>());
    (load_case.empty() ? unbounded : cases[std::string(load_case)]["unbounded"]).push_back(std::string(response));
  }
  json["unbounded"] = std::move(unbounded);
  if (!cases.empty()) json["cases"] = std::move(cases);
}

/// What is told of all cases together, out of the rest of `model`.
void take_mission_out(Json& json) {
  if (!json.contains("model")) return;
  constexpr std::string_view kPrefix = optimizer::kMissionPrefix;
  Json rest = Json::object(), mission = Json::object();
  for (const auto& [key, value] : json.at("model").items()) {
    if (!key.starts_with(kPrefix)) {
      rest[key] = value;
      continue;
    }
    const std::string name = key.substr(kPrefix.size());
    const bool yes_or_no = name == "order_matters" || name == "confirmed_by_history";
    mission[name] = yes_or_no ? Json(value != 0) : value;
  }
  json["model"] = std::move(rest);
  if (!mission.empty()) json["mission"] = std::move(mission);
}

/// What the terms of the objective come to over all cases.
Json objective_json(const optimizer::Problem& problem, const optimizer::Evaluation& evaluation) {
  Json terms = Json::array();
  for (const optimizer::ObjectiveTerm& term : problem.objective) {
    const auto [value, bar] =
        as_response(term, term_value(problem, term, evaluation.responses, evaluation.error_estimates));
    Json& json = terms.emplace_back(Json{{"response", term.response}});
    if (!problem.cases.empty()) json["over"] = term.over;
    json["value"] = value;
    json["error_estimate"] = optimizer::json_value<Json>(bar);
  }
  return terms;
}

}  // namespace

std::string evaluation_json(const optimizer::Evaluation& evaluation, const nlohmann::ordered_json* accuracy,
                            const optimizer::Problem* problem) {
  Json json{{"version", kAnswerVersion}};
  json.update(json_of(evaluation));
  if (evaluation.derivatives.empty()) json.erase("derivatives");
  take_cases_out(json);
  take_mission_out(json);
  if (json.contains("cases"))
    for (Json& in_case : json["cases"]) take_mission_out(in_case);
  if (problem && evaluation.converged() && !problem->objective.empty())
    json["objective"] = objective_json(*problem, evaluation);
  if (accuracy) json["accuracy"] = *accuracy;
  return text(json);
}

}  // namespace dovetail::studies
