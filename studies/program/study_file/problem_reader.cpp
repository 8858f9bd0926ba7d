#include "studies/program/study_file/problem_reader.hpp"

#include <algorithm>
#include <map>

#include "optimizer/responses/response_table.hpp"

namespace dovetail::studies {

std::string left_aside_words(const optimizer::Scene& scene) {
  return "changes nothing with contact.wear_law = \"" + scene.contact.wear_law + "\"";
}

namespace {

using optimizer::DesignVariable;
using optimizer::ObjectiveTerm;
using optimizer::Parameter;
using optimizer::ResponseConstraint;

/// The tables of `[[kind]]`, each with its path "kind[0]"; anything else of that name is reported.
std::vector<std::pair<const Node*, std::string>> entries(SectionReader& root, const std::string& kind,
                                                         Problems& problems) {
  std::vector<std::pair<const Node*, std::string>> found;
  const Node* list = root.take(kind);
  if (!list) return found;
  if (list->kind != Node::Kind::list) {
    problems.add(*list, kind, "must be written as [[" + kind + "]], once for each");
    return found;
  }
  for (const Node& item : list->items) {
    const std::string path = kind + "[" + std::to_string(found.size()) + "]";
    if (item.kind == Node::Kind::table)
      found.emplace_back(&item, path);
    else
      problems.add(item, path, "must be a section, [[" + kind + "]]");
  }
  return found;
}

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

/// "geometry.left.KEY", ... of "geometry.KEY".
std::vector<std::string> of_flanks(const std::string& key) {
  std::vector<std::string> keys;
  for (const geometry::FlankPlace& place : geometry::kFlanks)
    keys.push_back("geometry." + std::string(place.name) + key.substr(key.find('.')));
  return keys;
}

/// Why that key cannot be a variable although it is a number; empty when it can.
std::string conflict(const Node* root, const Parameter& parameter) {
  if (parameter.kind != Parameter::Kind::real) return "cannot be varied: it is not a real number";
  const std::string& key = parameter.key;
  for (const char* section : {"mesh", "solver"})
    if (is_prefix_section(key, section)) return "cannot be varied: it is no property of a design";
  if (is_prefix_section(key, "material.blade")) {
    const std::string disk = "material.disk." + key.substr(key.rfind('.') + 1);
    if (!given(root, disk)) return "cannot be varied unless " + disk + " is given: the disk would follow the blade";
  }
  if (is_prefix_section(key, "geometry") && key.find('.') == key.rfind('.'))
    for (const std::string& one : of_flanks(key)) {
      if (optimizer::find_parameter(one) && given(root, one))
        return "cannot vary both flanks while " + one + " fixes one of them";
    }
  return {};
}

/// Two keys that set the same number.
bool overlap(const std::string& a, const std::string& b) {
  if (a == b) return true;
  const auto is_one_of = [](const std::string& one, const std::vector<std::string>& keys) {
    return std::ranges::find(keys, one) != keys.end();
  };
  return is_one_of(b, of_flanks(a)) || is_one_of(a, of_flanks(b));
}

const Parameter* variable_parameter(const Node& value, const std::string& path, const Node* root, Problems& problems) {
  const Parameter* parameter = optimizer::find_parameter(value.text);
  if (!parameter) {
    std::vector<std::string> keys;
    for (const Parameter& p : optimizer::scene_parameters()) keys.push_back(p.key);
    std::string near;
    for (const std::string& key : keys)
      if (key.ends_with("." + value.text)) near = near.empty() ? key : near;
    if (near.empty()) near = nearest(value.text, keys);
    problems.add(value, path, "is not a key of the scene" + (near.empty() ? "" : "; did you mean \"" + near + "\"?"));
    return nullptr;
  }
  const std::string why = conflict(root, *parameter);
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

std::vector<DesignVariable> read_variables(SectionReader& root, const optimizer::Scene& scene, Problems& problems) {
  std::vector<DesignVariable> variables;
  for (const auto& [node, path] : entries(root, "variable", problems)) {
    SectionReader section(node, path, problems);
    const std::optional<std::string> key = section.text("key", {}, true);
    const Parameter* parameter =
        key ? variable_parameter(*node->find("key"), section.path("key"), root.node(), problems) : nullptr;
    const Range range = parameter ? parameter->range : kAnyNumber;
    const std::optional<double> lower = section.number("lower", range, true);
    const std::optional<double> upper = section.number("upper", range, true);
    const std::optional<double> start = section.number("start", range);
    section.finish();
    if (!parameter) continue;
    for (const auto& [name, bound] : {std::pair{"lower", lower}, std::pair{"upper", upper}})
      if (bound && range.is_zero_apart(*bound))
        problems.add(
            *node->find(name), section.path(name),
            range.interval().phrase() + ": 0 means " + std::string(range.zero) + " and cannot be part of a range");
    if (parameter->left_aside(scene)) problems.add(*node->find("key"), section.path("key"), left_aside_words(scene));
    for (const DesignVariable& other : variables)
      if (overlap(other.key, *key))
        problems.add(*node->find("key"), section.path("key"),
                     other.key == *key ? "is already a variable; name it once"
                                       : "sets the same dimension as the variable " + other.key);
    DesignVariable variable{.key = *key, .start = start.value_or(optimizer::parameter(scene, *key))};
    if (lower && upper) {
      variable.lower = *lower;
      variable.upper = *upper;
      const std::string between = "must be between lower = " + shortest(*lower) + " and upper = " + shortest(*upper);
      if (!(*lower < *upper))
        problems.add(*node->find("upper"), section.path("upper"), "must be > lower = " + shortest(*lower));
      else if (start && (*start < *lower || *start > *upper))
        problems.add(*node->find("start"), section.path("start"), between);
      else if (!start && !problems.has(*key))
        start_from_value(variable, from_command_line(root.node(), *key), *node, path, problems);
    }
    variables.push_back(std::move(variable));
  }
  return variables;
}

/// The response a term or limit names, checked; empty when absent or wrong.
std::string read_response(SectionReader& section, Problems& problems) {
  const std::optional<std::string> name = section.text("response", {}, true);
  if (!name || optimizer::find_response(*name)) return name.value_or("");
  std::vector<std::string> names;
  for (const optimizer::Response& r : optimizer::responses()) names.emplace_back(r.name);
  std::string allowed = "is not a response";
  if (const std::string near = nearest(*name, names); !near.empty())
    allowed += "; did you mean \"" + near + "\"?";
  else {
    allowed += "; the responses are";
    for (const std::string& known : names) allowed += " " + known;
  }
  problems.add(*section.node()->find("response"), section.path("response"), allowed);
  return {};
}

/// Accuracy asked of one response; 0 where it is not.
/// @param of_all  whether one is asked of the others
double read_accuracy(SectionReader& section, bool of_all, Problems& problems) {
  const std::optional<double> accuracy = section.number("accuracy", kAccuracyRange);
  if (accuracy && !of_all)
    problems.add(*section.node()->find("accuracy"), section.path("accuracy"),
                 "counts only where solver.accuracy or optimizer.verify_accuracy is given, for all other responses");
  return accuracy.value_or(0);
}

std::vector<ObjectiveTerm> read_objective(SectionReader& root, bool accurate, Problems& problems) {
  std::vector<ObjectiveTerm> terms;
  const auto tables = entries(root, "objective", problems);
  for (const auto& [node, path] : tables) {
    SectionReader section(node, path, problems);
    ObjectiveTerm term;
    term.response = read_response(section, problems);
    term.weight = section.number("weight", kAnyNumber).value_or(1);
    const std::optional<double> scale = section.number("scale", kPositive);
    term.scale = scale.value_or(0);
    term.absolute = section.truth("absolute").value_or(false);
    term.accuracy = read_accuracy(section, accurate, problems);
    section.finish();
    if (term.weight == 0)
      problems.add(*node->find("weight"), section.path("weight"), "must not be 0: the term would have no effect");
    if (tables.size() > 1 && !node->find("scale"))
      problems.missing(node, section.path("scale"),
                       "is missing; with several objectives each needs the size of response that counts as 1");
    terms.push_back(std::move(term));
  }
  return terms;
}

std::vector<ResponseConstraint> read_constraints(SectionReader& root, bool accurate, Problems& problems) {
  std::vector<ResponseConstraint> limits;
  std::map<std::pair<std::string, bool>, std::pair<double, double>> band;
  for (const auto& [node, path] : entries(root, "constraint", problems)) {
    SectionReader section(node, path, problems);
    ResponseConstraint limit;
    limit.response = read_response(section, problems);
    limit.lower = section.number("lower", kAnyNumber);
    limit.upper = section.number("upper", kAnyNumber);
    limit.scale = section.number("scale", kPositive).value_or(0);
    limit.absolute = section.truth("absolute").value_or(false);
    limit.accuracy = read_accuracy(section, accurate, problems);
    section.finish();
    const Node* lower = node->find("lower");
    const Node* upper = node->find("upper");
    if (!lower && !upper) problems.missing(node, path, "needs an upper or a lower limit, or both");
    if (!node->find("scale") && ((limit.upper && *limit.upper == 0) || (limit.lower && *limit.lower == 0)))
      problems.missing(node, section.path("scale"), "is missing; a limit of 0 needs the size of a notable violation");
    if (limit.absolute && limit.upper && *limit.upper < 0)
      problems.add(*upper, section.path("upper"), "must be >= 0: a magnitude is limited");
    if (limit.response.empty()) continue;
    const auto fresh = std::pair(-kInfinity, kInfinity);
    auto& [floor, ceiling] = band.try_emplace({limit.response, limit.absolute}, fresh).first->second;
    floor = std::max(floor, limit.lower.value_or(-kInfinity));
    ceiling = std::min(ceiling, limit.upper.value_or(kInfinity));
    if (floor > ceiling)
      problems.add(limit.upper ? *upper : *lower, section.path(limit.upper ? "upper" : "lower"),
                   "contradicts the other limit of " + limit.response + ": nothing is >= " + shortest(floor) +
                       " and <= " + shortest(ceiling));
    limits.push_back(std::move(limit));
  }
  return limits;
}

}  // namespace

optimizer::Problem read_problem(SectionReader& root, const optimizer::Scene& scene,
                                const optimizer::OptimizerOptions& options, Problems& problems) {
  optimizer::Problem problem;
  std::vector<DesignVariable> variables = read_variables(root, scene, problems);
  const bool accurate = scene.solver.accuracy > 0 || options.verify_accuracy > 0;
  problem.objective = read_objective(root, accurate, problems);
  problem.constraints = read_constraints(root, accurate, problems);
  const bool varies = root.node() && root.node()->find("variable");
  if (problem.objective.empty() && (varies || (root.node() && root.node()->find("objective"))))
    problems.missing(nullptr, "objective",
                     "is missing; a study with variables needs at least one [[objective]] with a response");
  if (problems.empty()) problem.space = optimizer::DesignSpace(std::move(variables));
  return problem;
}

}  // namespace dovetail::studies
