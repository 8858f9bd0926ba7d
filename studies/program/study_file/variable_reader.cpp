#include "studies/program/study_file/variable_reader.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include "studies/program/study_file/scene_keys.hpp"

namespace dovetail::studies {

std::string left_aside_words(const optimizer::Scene& scene) {
  return "changes nothing with contact.wear_law = \"" + scene.contact.wear_law + "\"";
}

namespace {

using optimizer::DesignVariable;
using optimizer::Parameter;

bool is_prefix_section(const std::string& key, const std::string& section) {
  return key.starts_with(section + ".");
}

bool given(const Node* root, std::string_view key) {
  return root && root->at(key);
}

bool from_command_line(const Node* root, std::string_view key) {
  const Node* node = root ? root->at(key) : nullptr;
  return node && !node->origin.empty();
}

}  // namespace

std::string conflict_of_variable(const Node* root, const Parameter& parameter) {
  if (parameter.kind != Parameter::Kind::real)
    return "cannot be varied: it is not a real number; evaluate the design with one value after the other (--set)";
  const std::string& key = parameter.key;
  for (const char* section : {"mesh", "solver"})
    if (is_prefix_section(key, section)) return "cannot be varied: it is no property of a design";
  if (const Node* material = root ? root->at("material") : nullptr;
      material && material->kind == Node::Kind::text && is_prefix_section(key, "material"))
    return "cannot be varied beside material = " + material->shown() +
           ", which is of both bodies; give [material.blade] and [material.disk] with grade = " + material->shown() +
           " instead";
  if (is_prefix_section(key, "material.blade")) {
    const std::string disk = "material.disk." + key.substr(key.rfind('.') + 1);
    if (!given(root, disk) && !given(root, "material.disk.grade"))
      return "cannot be varied unless " + disk + " is given: the disk would follow the blade";
  }
  if (is_prefix_section(key, "geometry") && key.find('.') == key.rfind('.'))
    for (const std::string& one : optimizer::flank_keys(key)) {
      if (given(root, one)) return "cannot vary both flanks while " + one + " fixes one of them";
    }
  return {};
}

namespace {

const Parameter* variable_parameter(const Node& value, const std::string& path, const Node* root, Problems& problems) {
  const Parameter* parameter = scene_key(value.text, value, path, problems);
  if (parameter == nullptr) return nullptr;
  const std::string why = conflict_of_variable(root, *parameter);
  if (why.empty()) return parameter;
  problems.add(value, path, why);
  return nullptr;
}

/// A value given on the command line may leave the bounds, which are for the search: it then starts at the nearest one.
void start_from_value(DesignVariable& variable, bool overridden, const Node& node, const std::string& path,
                      Problems& problems) {
  const double value = variable.start;
  if (overridden) variable.start = std::clamp(value, variable.lower, variable.upper);
  if (variable.start < variable.lower || variable.start > variable.upper)
    problems.missing(&node, variable.key + " = " + shortest(value),
                     "is the start of " + path + " and must be between lower = " + shortest(variable.lower) +
                         " and upper = " + shortest(variable.upper) + ", or give the variable a start");
}

/// What a variable varies: `key`, or all of `keys` alike. Each stands at a node, by which it is reported.
std::vector<const Node*> variable_keys(SectionReader& section, Problems& problems) {
  const Node* list = section.take("keys");
  if (list == nullptr) {
    const std::optional<std::string> key = section.text("key", {}, true);
    return key ? std::vector{section.node()->find("key")} : std::vector<const Node*>();
  }
  std::vector<const Node*> keys;
  const auto is_text = [](const Node& item) { return item.kind == Node::Kind::text; };
  if (section.take("key") != nullptr)
    problems.add(*list, section.path("keys"), "must not be given beside key");
  else if (list->kind != Node::Kind::list || list->items.empty() || !std::ranges::all_of(list->items, is_text))
    problems.add(*list, section.path("keys"), "must be a list of keys, which all have the value of the variable");
  else
    for (const Node& item : list->items) keys.push_back(&item);
  return keys;
}

}  // namespace

std::vector<DesignVariable> read_variables(SectionReader& root, const optimizer::Scene& scene, Problems& problems) {
  std::vector<DesignVariable> variables;
  for (const auto& [node, path] : entries(root, "variable", problems)) {
    SectionReader section(node, path, problems);
    const std::vector<const Node*> keys = variable_keys(section, problems);
    const std::string at = section.path(node->find("keys") ? "keys" : "key");
    std::vector<const Parameter*> parameters;
    for (const Node* key : keys)
      if (const Parameter* parameter = variable_parameter(*key, at, root.node(), problems))
        parameters.push_back(parameter);
    const Range range = parameters.empty() ? kAnyNumber : parameters.front()->range;
    const std::optional<double> lower = section.number("lower", range, true);
    const std::optional<double> upper = section.number("upper", range, true);
    const std::optional<double> start = section.number("start", range);
    section.finish();
    if (parameters.empty() || parameters.size() < keys.size()) continue;
    for (std::size_t i = 0; i < keys.size(); ++i) {
      const Range& own = parameters[i]->range;
      for (const auto& [name, bound] : {std::pair{"lower", lower}, std::pair{"upper", upper}}) {
        if (bound && own.is_zero_apart(*bound))
          problems.add(
              *node->find(name), section.path(name),
              own.interval().phrase() + ": 0 means " + std::string(own.zero) + " and cannot be part of a range");
        if (bound && i > 0 && !own.contains(*bound))
          problems.add(*node->find(name), section.path(name), own.phrase() + " for " + parameters[i]->key);
      }
      if (parameters[i]->left_aside(scene)) problems.add(*keys[i], at, left_aside_words(scene));
      const auto taken = [&](const std::string& other) {
        if (overlap(other, keys[i]->text))
          problems.add(*keys[i], at,
                       other == keys[i]->text ? "is already a variable; name it once"
                                              : "sets the same dimension as the variable " + other);
      };
      for (const DesignVariable& other : variables) {
        taken(other.key);
        for (const std::string& also : other.also) taken(also);
      }
      for (std::size_t k = 0; k < i; ++k) taken(keys[k]->text);
    }
    const std::string& key = keys.front()->text;
    DesignVariable variable{.key = key, .start = start.value_or(optimizer::parameter(scene, key))};
    for (std::size_t i = 1; i < keys.size(); ++i) variable.also.push_back(keys[i]->text);
    if (lower && upper) {
      variable.lower = *lower;
      variable.upper = *upper;
      const std::string between = "must be between lower = " + shortest(*lower) + " and upper = " + shortest(*upper);
      if (!(*lower < *upper))
        problems.add(*node->find("upper"), section.path("upper"), "must be > lower = " + shortest(*lower));
      else if (start && (*start < *lower || *start > *upper))
        problems.add(*node->find("start"), section.path("start"), between);
      else if (!start && !problems.has(key))
        start_from_value(variable, from_command_line(root.node(), key), *node, path, problems);
    }
    variables.push_back(std::move(variable));
  }
  return variables;
}

}  // namespace dovetail::studies
