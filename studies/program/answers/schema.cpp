#include "studies/program/answers/schema.hpp"

#include <algorithm>
#include <cmath>

#include "optimizer/journal/evaluation_json.hpp"
#include "optimizer/problem/optimizer_options.hpp"
#include "optimizer/problem/uncertainty.hpp"
#include "optimizer/responses/response_table.hpp"
#include "optimizer/scene/scene.hpp"
#include "studies/program/answers/version.hpp"
#include "studies/program/engine/json_values.hpp"
#include "studies/program/study_file/export.hpp"
#include "studies/program/study_file/key_words.hpp"
#include "studies/program/study_file/materials.hpp"
#include "studies/program/study_file/study_template.hpp"

namespace dovetail::studies {
namespace {

constexpr const char* kDraft = "https://json-schema.org/draft/2020-12/schema";

Json texts(const auto& names) {
  Json list = Json::array();
  for (const auto& name : names) list.push_back(std::string(name));
  return list;
}

Json one_of_texts(const auto& names) {
  return {{"enum", texts(names)}};
}

/// A number within its range; a 0 of its own beside it.
Json number_schema(const Range& range, bool whole = false) {
  Json schema{{"type", whole ? "integer" : "number"}};
  if (std::isfinite(range.lower)) schema[range.lower_open ? "exclusiveMinimum" : "minimum"] = range.lower;
  if (std::isfinite(range.upper)) schema[range.upper_open ? "exclusiveMaximum" : "maximum"] = range.upper;
  if (range.zero.empty()) return schema;
  return {{"anyOf", Json::array({{{"const", 0}}, schema})}};
}

template <class S>
Json field_schema(const Field<S>& field) {
  Json schema;
  if (is_text(field))
    schema = choices_of(field).empty() ? Json{{"type", "string"}} : one_of_texts(choices_of(field));
  else if (std::holds_alternative<bool S::*>(field.member))
    schema = {{"type", "boolean"}};
  else
    schema = number_schema(field.range, std::holds_alternative<int S::*>(field.member));
  schema["description"] = capitalised(field.help);
  return schema;
}

/// A table of a study file, to which keys are added.
Json section() {
  return {{"type", "object"}, {"properties", Json::object()}, {"additionalProperties", false}};
}

/// The schema of a dotted section below another one, made where there is none.
Json& section_at(Json& root, const std::string& path) {
  Json* at = &root;
  std::string rest = path;
  while (!rest.empty()) {
    const std::size_t dot = std::min(rest.find('.'), rest.size());
    Json& properties = (*at)["properties"];
    const std::string name = rest.substr(0, dot);
    if (!properties.contains(name)) properties[name] = section();
    at = &properties[name];
    rest.erase(0, std::min(dot + 1, rest.size()));
  }
  return *at;
}

template <class S>
void add_fields(Json& schema, std::span<const Field<S>> table) {
  for (const Field<S>& field : table) schema["properties"][std::string(field.key)] = field_schema(field);
}

/// A list of tables with these keys.
Json tables(const Json& properties, const Json& required, const Json& others = false) {
  return {{"type", "array"},
          {"items",
           {{"type", "object"}, {"properties", properties}, {"required", required}, {"additionalProperties", others}}}};
}

const Json kText{{"type", "string"}}, kNumber{{"type", "number"}}, kTruth{{"type", "boolean"}};

Json response_names() {
  return one_of_texts(optimizer::response_names());
}

void add_problem(Json& properties) {
  const Json positive = number_schema(kPositive), accuracy = number_schema(kAccuracyRange);
  const Json keys{{"type", "array"}, {"items", kText}, {"minItems", 1}};
  properties["variable"] = tables(
      {{"key", kText}, {"keys", keys}, {"lower", kNumber}, {"upper", kNumber}, {"start", kNumber}}, {"lower", "upper"});
  properties["linked"] = tables({{"key", kText}, {"value", kText}}, {"key", "value"});
  const Json aim{{"anyOf", Json::array({one_of_texts(std::vector<std::string>{"min", "max", "zero"}), kNumber})}};
  properties["objective"] = tables({{"response", response_names()},
                                    {"weight", kNumber},
                                    {"scale", positive},
                                    {"reference", kNumber},
                                    {"absolute", kTruth},
                                    {"aim", aim},
                                    {"over", kText},
                                    {"accuracy", accuracy}},
                                   Json::array({"response"}));
  properties["constraint"] = tables({{"response", response_names()},
                                     {"lower", kNumber},
                                     {"upper", kNumber},
                                     {"scale", positive},
                                     {"absolute", kTruth},
                                     {"over", kText},
                                     {"accuracy", accuracy}},
                                    Json::array({"response"}));
  // Any number of the scene by its dotted key in quotes, or in tables.
  const Json change{{"type", Json::array({"number", "object"})}};
  properties["case"] = tables({{"name", kText}, {"weight", positive}}, Json::array({"name"}), change);
  properties["uncertain"] = tables({{"key", kText},
                                    {"distribution", one_of_texts(names_of<optimizer::Distribution>())},
                                    {"lower", kNumber},
                                    {"upper", kNumber},
                                    {"plus_minus", positive},
                                    {"relative", number_schema({.lower = 0, .upper = 1, .lower_open = true})},
                                    {"mean", kNumber}},
                                   Json::array({"key"}));
}

bool is_number(const Json& schema) {
  if (schema.contains("anyOf")) return std::ranges::any_of(schema["anyOf"], is_number);
  return schema.contains("type") && (schema["type"] == "number" || schema["type"] == "integer");
}

/// Says what each key below a table means that has no words yet, and the unit of each number ("1": a pure one).
void add_words(Json& table, const std::string& above) {
  if (table.contains("anyOf"))
    for (Json& choice : table["anyOf"]) add_words(choice, above);
  if (table.contains("items")) add_words(table["items"], above);
  if (!table.contains("properties")) return;
  for (auto& [key, schema] : table["properties"].items()) {
    const std::string path = above + key;
    const KeyWords words = key_words(path);
    if (!schema.contains("description") && !words.words.empty()) schema["description"] = std::string(words.words);
    if (is_number(schema)) {
      const std::string unit = words.unit.empty() ? unit_of_key(key) : std::string(words.unit);
      schema["unit"] = unit.empty() ? "1" : unit;
    }
    add_words(schema, path + ".");
  }
}

/// The type of a value that an answer has.
template <class T>
Json type_schema() {
  if constexpr (std::is_same_v<T, bool>) return kTruth;
  if constexpr (std::is_same_v<T, double>) return {{"type", Json::array({"number", "null"})}};
  if constexpr (std::is_same_v<T, std::string>) return kText;
  if constexpr (requires { typename T::mapped_type; })
    return {{"type", "object"}, {"additionalProperties", type_schema<typename T::mapped_type>()}};
  else if constexpr (requires { typename T::value_type; } && !std::is_same_v<T, std::string>)
    return {{"type", "array"}, {"items", type_schema<typename T::value_type>()}};
  return {};
}

}  // namespace

std::string study_schema() {
  Json root = section();
  Json schema{{"$schema", kDraft}, {"title", "dovetail study"}};
  Json& properties = root["properties"];
  properties["name"] = {{"type", "string"}, {"pattern", "^[A-Za-z0-9_-][A-Za-z0-9._-]*$"}, {"maxLength", 100}};
  properties["title"] = kText;
  optimizer::Scene scene;
  optimizer::visit_tables(scene, [&]<class S>(std::string_view name, S&, std::span<const Field<S>> table) {
    add_fields(section_at(root, std::string(name)), table);
    // Keys of all flanks.
    if constexpr (std::is_same_v<S, geometry::FlankParameters>) add_fields(section_at(root, "geometry"), table);
  });
  std::string materials;
  for (const NamedMaterial& material : named_materials())
    materials += (materials.empty() ? "" : ", ") + std::string(material.name);
  for (const char* body : {"material.blade", "material.disk"})
    section_at(root, body)["properties"]["grade"] = kText;  // capital letters do not count
  properties["material"] = {
      {"anyOf", Json::array({kText, properties["material"]})},
      {"description", "Of both bodies the name of a material (" + materials + "), or a table of each."}};
  add_fields(section_at(root, "optimizer"), option_table<optimizer::OptimizerOptions>());
  add_fields(section_at(root, "robust"), option_table<optimizer::RobustOptions>());
  add_problem(properties);
  section_at(root, "export")["properties"]["formats"] = {{"type", "array"},
                                                         {"items", one_of_texts(names_of<ExportFormat>())}};
  add_words(root, "");
  schema.update(root);
  return text(schema);
}

std::string evaluation_schema() {
  Json schema{{"$schema", kDraft}, {"title", "answer of dovetail evaluate"}, {"type", "object"}};
  schema["properties"]["version"] = {{"const", kAnswerVersion}};
  Json required = Json::array({"version"});
  optimizer::each_field<optimizer::Evaluation>([&](const auto& field) {
    using T = std::decay_t<decltype(std::declval<optimizer::Evaluation>().*field.member)>;
    schema["properties"][std::string(field.name)] = type_schema<T>();
    if (std::string_view(field.name) != "derivatives") required.push_back(std::string(field.name));
  });
  schema["properties"]["objective"] = tables({{"response", kText},
                                              {"over", kText},
                                              {"value", type_schema<double>()},
                                              {"error_estimate", type_schema<double>()}},
                                             Json::array({"response", "value", "error_estimate"}));
  schema["required"] = required;
  return text(schema);
}

namespace {

/// An answer that lists rows under a name; every row has all keys.
std::string list_schema(const char* command, const char* name, const Json& row) {
  Json keys = Json::array();
  for (const auto& [key, type] : row.items()) keys.push_back(key);
  return text({{"$schema", kDraft},
               {"title", std::string("answer of dovetail ") + command},
               {"type", "object"},
               {"properties", {{"version", {{"const", kAnswerVersion}}}, {name, tables(row, keys)}}},
               {"required", Json::array({"version", name})}});
}

}  // namespace

std::string runs_schema() {
  const Json count{{"type", "integer"}, {"minimum", 0}}, known = type_schema<double>();
  const Json values = type_schema<std::map<std::string, double>>();
  return list_schema("runs", "runs",
                     {{"directory", kText},
                      {"name", kText},
                      {"status", kText},
                      {"evaluations", count},
                      {"feasible", count},
                      {"failed", count},
                      {"best", {{"type", Json::array({"integer", "null"})}, {"minimum", 1}}},
                      {"objective", known},
                      {"start", known},
                      {"variables", values},
                      {"responses", values},
                      {"seconds", {{"type", "number"}, {"minimum", 0}}}});
}

std::string materials_schema() {
  Json row{{"name", kText}};
  for (const Field<fem::Material>& field : option_table<fem::Material>())
    row[std::string(field.key)] = number_schema(field.range);
  row["source"] = kText;
  return list_schema("materials", "materials", row);
}

}  // namespace dovetail::studies
