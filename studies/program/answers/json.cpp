#include "studies/program/answers/json.hpp"

#include "optimizer/journal/evaluation_json.hpp"
#include "studies/program/engine/json_values.hpp"

namespace dovetail::studies {

std::string evaluation_json(const optimizer::Evaluation& evaluation, const nlohmann::ordered_json* accuracy) {
  Json json = json_of(evaluation);
  if (evaluation.derivatives.empty()) json.erase("derivatives");
  if (accuracy) json["accuracy"] = *accuracy;
  return text(json);
}

}  // namespace dovetail::studies
