#include "optimizer/evaluation_json.hpp"

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <stdexcept>

namespace dovetail::optimizer {

namespace {

using nlohmann::json;

json number(double value) {
  if (std::isnan(value)) return "nan";
  if (std::isinf(value)) return value > 0 ? "inf" : "-inf";
  return value;
}

double number(const json& value) {
  if (value.is_number()) return value.get<double>();
  const std::string text = value.get<std::string>();
  if (text == "nan") return std::numeric_limits<double>::quiet_NaN();
  if (text == "inf") return std::numeric_limits<double>::infinity();
  if (text == "-inf") return -std::numeric_limits<double>::infinity();
  throw std::runtime_error("'" + text + "' is no number");
}

json numbers(const std::vector<double>& values) {
  json list = json::array();
  for (const double value : values) list.push_back(number(value));
  return list;
}

std::vector<double> numbers(const json& list) {
  std::vector<double> values;
  for (const json& value : list) values.push_back(number(value));
  return values;
}

json named(const std::map<std::string, double>& values) {
  json object = json::object();
  for (const auto& [name, value] : values) object[name] = number(value);
  return object;
}

json nested(const std::map<std::string, std::map<std::string, double>>& values) {
  json object = json::object();
  for (const auto& [name, parts] : values) object[name] = named(parts);
  return object;
}

std::map<std::string, double> named(const json& object) {
  std::map<std::string, double> values;
  for (const auto& [name, value] : object.items()) values[name] = number(value);
  return values;
}

}  // namespace

std::string record_text(std::size_t index, const JournalRecord& record) {
  const Evaluation& e = record.evaluation;
  json derivatives = json::object();
  for (const auto& [name, gradient] : e.derivatives) derivatives[name] = numbers(gradient);
  const json object{{"index", index},
                    {"x", numbers(record.x)},
                    {"status", e.status},
                    {"feasible", e.feasible},
                    {"parameters", named(e.parameters)},
                    {"responses", named(e.responses)},
                    {"constraints", named(e.constraints)},
                    {"error_estimates", named(e.error_estimates)},
                    {"error_sources", nested(e.error_sources)},
                    {"unbounded", e.unbounded},
                    {"undecided_constraints", e.undecided_constraints},
                    {"model", named(e.model)},
                    {"timings_s", named(e.timings_s)},
                    {"messages", e.messages},
                    {"derivatives", derivatives}};
  return object.dump(-1, ' ', false, json::error_handler_t::replace);
}

JournalRecord record_from_text(const std::string& text, std::size_t expected_index) {
  const json object = json::parse(text);
  const auto index = object.at("index").get<std::size_t>();
  if (index != expected_index)
    throw std::runtime_error("holds record " + std::to_string(index) + " where record " +
                             std::to_string(expected_index) + " belongs");
  JournalRecord record;
  record.x = numbers(object.at("x"));
  Evaluation& e = record.evaluation;
  e.status = object.at("status").get<std::string>();
  e.feasible = object.at("feasible").get<bool>();
  e.parameters = named(object.at("parameters"));
  e.responses = named(object.at("responses"));
  e.constraints = named(object.at("constraints"));
  e.error_estimates = named(object.at("error_estimates"));
  for (const auto& [name, parts] : object.at("error_sources").items()) e.error_sources[name] = named(parts);
  e.unbounded = object.at("unbounded").get<std::vector<std::string>>();
  e.undecided_constraints = object.at("undecided_constraints").get<std::vector<std::string>>();
  e.model = named(object.at("model"));
  e.timings_s = named(object.at("timings_s"));
  e.messages = object.at("messages").get<std::vector<std::string>>();
  for (const auto& [name, gradient] : object.at("derivatives").items()) e.derivatives[name] = numbers(gradient);
  return record;
}

}  // namespace dovetail::optimizer
