#include "studies/program/json.hpp"

#include "studies/program/json_values.hpp"

namespace dovetail::studies {

std::string evaluation_json(const optimizer::Evaluation& evaluation) {
  Json json;
  json["status"] = evaluation.status;
  json["feasible"] = evaluation.feasible;
  json["parameters"] = numbers(evaluation.parameters);
  json["responses"] = numbers(evaluation.responses);
  json["constraints"] = numbers(evaluation.constraints);
  json["error_estimates"] = numbers(evaluation.error_estimates);
  json["error_sources"] = Json::object();
  for (const auto& [response, sources] : evaluation.error_sources) json["error_sources"][response] = numbers(sources);
  json["unbounded"] = evaluation.unbounded;
  json["undecided_constraints"] = evaluation.undecided_constraints;
  json["model"] = numbers(evaluation.model);
  json["timings_s"] = numbers(evaluation.timings_s);
  json["messages"] = evaluation.messages;
  if (!evaluation.derivatives.empty()) {
    json["derivatives"] = Json::object();
    for (const auto& [name, gradient] : evaluation.derivatives) json["derivatives"][name] = numbers(gradient);
  }
  return text(json);
}

}  // namespace dovetail::studies
