#include "studies/program/answers/accuracy_json.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

namespace dovetail::studies {

namespace {

using Json = nlohmann::ordered_json;

Json settings_json(const optimizer::Scene& scene, const optimizer::Settings& settings) {
  Json json = Json::object();
  for (const auto& [key, value] : optimizer::settings_by_key(scene, settings)) {
    const bool whole = optimizer::find_parameter(key)->kind == optimizer::Parameter::Kind::whole;
    json[key] = whole ? Json(static_cast<long>(value)) : Json(value);
  }
  return json;
}

void add_dominant(const std::optional<optimizer::Dominant>& by, Json& json) {
  json["response"] = by ? Json(by->response) : Json();
  json["source"] = by ? Json(by->source) : Json();
  const bool known = by && std::isfinite(by->relative);  // else the mesh does not resolve the response
  json["relative_bar"] = known ? Json(by->relative) : Json();
  json["relative_bar_total"] = known ? Json(by->whole) : Json();
  json["asked"] = by ? Json(by->asked) : Json();
}

}  // namespace

Json accuracy_json(const optimizer::Scene& scene, const optimizer::SettingsChoice& choice) {
  Json json{{"status", to_string(choice.status)}, {"settings", settings_json(scene, choice.settings)}};
  add_dominant(choice.tried.by, json);
  json["not_held"] = choice.not_held;
  json["raised"] = choice.raised.empty() ? Json::object() : Json(choice.raised);
  json["rounds"] = Json::array();
  for (const optimizer::SettingsTried& tried : choice.rounds) {
    Json round{{"settings", settings_json(scene, tried.settings)}, {"status", tried.status}};
    add_dominant(tried.by, round);
    round["operations"] = tried.operations;
    round["out_of_line"] = tried.out_of_line;
    json["rounds"].push_back(std::move(round));
  }
  json["work"] = choice.work;
  json["one_more_digit"] = Json();
  if (choice.one_more_digit)
    json["one_more_digit"] = Json{{"settings", settings_json(scene, choice.one_more_digit->settings)},
                                  {"times_as_long", choice.one_more_digit->times_as_long}};
  return json;
}

}  // namespace dovetail::studies
