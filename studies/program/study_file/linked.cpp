#include "studies/program/study_file/linked.hpp"

#include <muParser.h>

#include <algorithm>
#include <limits>

#include "studies/program/study_file/scene_keys.hpp"
#include "studies/program/study_file/variable_reader.hpp"

namespace dovetail::studies {

namespace {

/// A key as a formula has it.
std::string name_in_formula(std::string key) {
  std::ranges::replace(key, '.', '_');
  return key;
}

/// The value of a formula; throws mu::Parser's error. A parser is made each time: it is no work beside an evaluation,
/// and several threads may ask.
double formula_value(const std::string& formula, const std::map<std::string, double>& numbers) {
  mu::Parser parser;
  for (const auto& [key, number] : numbers) parser.DefineConst(name_in_formula(key), number);
  parser.SetExpr(formula);
  const double value = parser.Eval();
  // Of several values muParser gives the last: "2,5 + a" would be 5 + a.
  if (parser.GetNumResults() != 1)
    throw mu::Parser::exception_type("a comma parts the arguments of a function; decimals have a point");
  return value;
}

/// The middle of the ranges, where the mesh of reference is made.
std::map<std::string, double> middle_of(const optimizer::DesignSpace& space) {
  std::vector<double> middle;
  for (const optimizer::DesignVariable& variable : space.variables())
    middle.push_back(variable.lower + (variable.upper - variable.lower) / 2);
  return space.settings(middle);
}

/// What the formula may be of.
std::string known_names(const std::map<std::string, double>& numbers) {
  std::string names;
  for (const auto& [key, number] : numbers) names += (names.empty() ? "" : ", ") + name_in_formula(key);
  return names.empty() ? "numbers alone: there is no design variable" : "the design variables " + names;
}

/// Why that key may not be linked; empty where it may.
std::string refusal_of(const std::string& key, const Node* root, const optimizer::Scene& scene,
                       const optimizer::Parameter& parameter, const optimizer::Problem& problem,
                       const std::vector<LinkedKey>& before) {
  if (std::string why = conflict_of_variable(root, parameter); !why.empty()) return why;
  if (parameter.left_aside(scene)) return left_aside_words(scene);
  const Node* given = root ? root->at(key) : nullptr;
  if (given && !given->origin.empty()) return "follows from the design variables and cannot be set";
  for (const auto& [other, value] : problem.space.settings(problem.space.start()))
    if (overlap(other, key)) return "is a design variable";
  for (const LinkedKey& other : before)
    if (overlap(other.key, key)) return "is linked already";
  for (const optimizer::LoadCase& load : problem.cases)
    for (const optimizer::KeyChange& change : load.changes)
      if (change.times == 0 && overlap(change.key, key))
        return "differs between cases and cannot follow from variables";
  return {};
}

}  // namespace

std::map<std::string, double> with_linked(std::map<std::string, double> settings, std::span<const LinkedKey> linked) {
  const std::map<std::string, double> variables = settings;
  for (const auto& [key, value] : linked) {
    double& number = settings[key] = std::numeric_limits<double>::quiet_NaN();
    try {
      number = formula_value(value, variables) + 0.0;  // no -0.0
    } catch (const mu::Parser::exception_type&) {
      // A value that does not exist is none of the key's range, and the design is refused.
    }
  }
  return settings;
}

std::vector<LinkedKey> read_linked(SectionReader& root, const optimizer::Problem& problem, optimizer::Scene& scene,
                                   Problems& problems) {
  std::vector<LinkedKey> linked;
  std::map<std::string, double> variables;
  const std::map<std::string, double> in_the_middle = middle_of(problem.space);
  for (const auto& [key, start] : problem.space.settings(problem.space.start()))
    variables[key] = optimizer::parameter(scene, key);
  for (const auto& [node, path] : entries(root, "linked", problems)) {
    SectionReader section(node, path, problems);
    const std::optional<std::string> key = section.text("key", {}, true), value = section.text("value", {}, true);
    section.finish();
    const Node* at = node->find("key");
    const optimizer::Parameter* parameter = key ? scene_key(*key, *at, section.path("key"), problems) : nullptr;
    if (parameter == nullptr || !value) continue;
    if (const std::string why = refusal_of(*key, root.node(), scene, *parameter, problem, linked); !why.empty()) {
      problems.add(*at, section.path("key"), why);
      continue;
    }
    const Node& formula = *node->find("value");
    try {
      const double number = formula_value(*value, variables), middle = formula_value(*value, in_the_middle);
      const auto refuse = [&](double wrong, const std::string& where) {
        problems.add(formula, section.path("value"),
                     "comes to " + shortest(wrong) + where + ", but " + *key + " " + parameter->range.phrase());
      };
      if (!parameter->range.contains(number))
        refuse(number, "");
      else if (!parameter->range.contains(middle))
        refuse(middle, " in the middle of the variables' ranges, where the mesh of all designs is made");
      else
        optimizer::set_parameter(scene, *key, number);
    } catch (const mu::Parser::exception_type& error) {
      problems.add(formula, section.path("value"),
                   "must be a formula of " + known_names(variables) + ": " + error.GetMsg());
    }
    linked.push_back({.key = *key, .value = *value});
  }
  return linked;
}

}  // namespace dovetail::studies
