#include "studies/program/study_file/problem_reader.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "optimizer/problem/missions.hpp"
#include "optimizer/responses/response_table.hpp"
#include "studies/program/study_file/case_reader.hpp"
#include "studies/program/study_file/variable_reader.hpp"

namespace dovetail::studies {

namespace {

using optimizer::DesignVariable;
using optimizer::ObjectiveTerm;
using optimizer::ResponseConstraint;

/// The response a term or limit names, checked; empty when absent or wrong.
std::string read_response(SectionReader& section, Problems& problems) {
  const std::optional<std::string> name = section.text("response", {}, true);
  if (!name || optimizer::find_response(*name)) return name.value_or("");
  const std::vector<std::string> names = optimizer::response_names();
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

/// Which cases count, and how.
/// @param several  whether there are cases, or samples of the one there is
std::string read_over(SectionReader& section, const std::vector<optimizer::LoadCase>& cases, bool several,
                      Problems& problems) {
  std::vector<std::string_view> allowed = names_of<optimizer::Over>();
  for (const optimizer::LoadCase& load : cases) allowed.push_back(load.name);
  const std::optional<std::string> over = section.text("over", allowed);
  if (over && !several)
    problems.add(*section.node()->find("over"), section.path("over"),
                 "says how cases count, but there is no [[case]], nor anything [[uncertain]]");
  return over.value_or(std::string(to_string(optimizer::Over::worst)));
}

/// What a term wants of its response, beside its weight: "min", "max", "zero" or a number to come near to.
void read_aim(SectionReader& section, ObjectiveTerm& term, Problems& problems) {
  const std::optional<bool> absolute = section.truth("absolute");
  term.absolute = absolute.value_or(false);
  const Node* aim = section.take("aim");
  const optimizer::Response* response = optimizer::find_response(term.response);
  // A number that may have either sign counts by its size unless told otherwise.
  if (aim == nullptr && !absolute && response != nullptr && response->either_sign && term.weight > 0)
    term.absolute = true;
  if (aim == nullptr) return;
  const bool text = aim->kind == Node::Kind::text;
  if (text ? aim->text != "min" && aim->text != "max" && aim->text != "zero"
           : !aim->is_number() || !std::isfinite(aim->real))
    return problems.add(*aim, section.path("aim"),
                        "must be \"min\", \"max\", \"zero\" or a number, in the response's SI unit, to come near to");
  if (absolute)
    problems.add(*section.node()->find("absolute"), section.path("absolute"),
                 "must not be given beside aim, which says the same");
  if (term.weight < 0)
    problems.add(*section.node()->find("weight"), section.path("weight"),
                 "must be > 0 beside aim: \"max\" turns the direction");
  term.absolute = !text || aim->text == "zero";
  term.target = text ? 0 : aim->real;
  if (text && aim->text == "max") term.weight = -term.weight;
}

/// Several objectives with weights are a sum; without, each is wanted for itself.
/// @param front  set to which of these
std::vector<ObjectiveTerm> read_objective(SectionReader& root, const std::vector<optimizer::LoadCase>& cases,
                                          bool several, bool accurate, bool& front, Problems& problems) {
  std::vector<ObjectiveTerm> terms;
  const auto tables = entries(root, "objective", problems);
  const auto weighted = std::ranges::count_if(tables, [](const auto& table) { return table.first->find("weight"); });
  front = tables.size() > 1 && weighted == 0;
  for (const auto& [node, path] : tables) {
    SectionReader section(node, path, problems);
    ObjectiveTerm term;
    term.response = read_response(section, problems);
    term.weight = section.number("weight", kAnyNumber).value_or(1);
    const std::optional<double> scale = section.number("scale", kPositive);
    term.scale = scale.value_or(0);
    term.reference = section.number("reference", kAnyNumber);
    read_aim(section, term, problems);
    term.over = read_over(section, cases, several, problems);
    term.accuracy = read_accuracy(section, accurate, problems);
    section.finish();
    if (term.weight == 0)
      problems.add(*node->find("weight"), section.path("weight"), "must not be 0: the term would have no effect");
    if (term.reference &&
        (term.over == to_string(optimizer::Over::deviation) || term.over == to_string(optimizer::Over::sum)))
      problems.add(*node->find("reference"), section.path("reference"),
                   "is a value of the response, which a " + term.over + " over cases is not: leave it out");
    if (front && scale)
      problems.add(*node->find("scale"), section.path("scale"),
                   "has a meaning in a sum of objectives, where all have a weight; without weights they make a front");
    const auto same = [&](const ObjectiveTerm& other) {
      return other.response == term.response && other.over == term.over && other.target == term.target;
    };
    if (front && std::ranges::any_of(terms, same))
      problems.add(*node->find("response"), section.path("response"), "is an objective of the front already");
    if (weighted > 0 && !node->find("weight"))
      problems.missing(node, section.path("weight"),
                       "is missing; of several objectives all have a weight, for their sum, or none, for a front");
    if (term.reference && !front)
      problems.add(*node->find("reference"), section.path("reference"),
                   "has a meaning where several objectives without weight make a front");
    if (tables.size() > 1 && weighted > 0 && !node->find("scale"))
      problems.missing(node, section.path("scale"),
                       "is missing; in a sum of several objectives each needs the size of response that counts as 1");
    terms.push_back(std::move(term));
  }
  return terms;
}

std::vector<ResponseConstraint> read_constraints(SectionReader& root, const std::vector<optimizer::LoadCase>& cases,
                                                 bool several, bool accurate, Problems& problems) {
  std::vector<ResponseConstraint> limits;
  std::map<std::tuple<std::string, bool, std::string>, std::pair<double, double>> band;
  for (const auto& [node, path] : entries(root, "constraint", problems)) {
    SectionReader section(node, path, problems);
    ResponseConstraint limit;
    limit.response = read_response(section, problems);
    limit.lower = section.number("lower", kAnyNumber);
    limit.upper = section.number("upper", kAnyNumber);
    limit.scale = section.number("scale", kPositive).value_or(0);
    limit.absolute = section.truth("absolute").value_or(false);
    limit.over = read_over(section, cases, several, problems);
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
    for (const ResponseConstraint& before : limits) {
      if (before.response != limit.response || before.absolute != limit.absolute || before.over != limit.over) continue;
      if (before.lower && lower) problems.add(*lower, section.path("lower"), "is limited from below already");
      if (before.upper && upper) problems.add(*upper, section.path("upper"), "is limited from above already");
    }
    auto& [floor, ceiling] = band.try_emplace({limit.response, limit.absolute, limit.over}, fresh).first->second;
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

/// What all cases wear off together is asked of one pair of flanks, each case at its own resonance before wear.
/// - `sampled`: something is uncertain
void refuse_missions(SectionReader& root, const optimizer::Scene& scene, const optimizer::Problem& problem,
                     bool sampled, Problems& problems) {
  const std::vector<std::string> names = optimizer::responses_of(problem);
  const bool followed = scene.loading.follow != wear::Follow::fixed;
  if (!optimizer::of_a_mission(names)) return;
  const bool refused = followed || optimizer::missions_of(problem.cases, true).empty();
  for (const char* table : {"objective", "constraint"})
    for (const auto& [node, path] : entries(root, table, problems)) {
      const Node* name = node->find("response");
      if (name == nullptr || !optimizer::of_a_mission({name->text})) continue;
      if (refused)
        problems.add(*name, path + ".response",
                     followed ? "is of flanks that wear at held frequencies: needs loading.follow = \"fixed\""
                              : "is of cases that act on the same flanks: none of them may change the geometry");
      const Node* over = node->find("over");
      if (!over || over->text == "worst" || (sampled && over->text != "sum")) continue;
      const bool of_each = name->text == optimizer::kMissionDrift.name;
      if (!of_each)
        problems.add(*over, path + ".over",
                     "must be \"worst\" or not be given: what all cases wear off together is one "
                     "number of them all");
      else if (named<optimizer::Over>(over->text))
        problems.add(*over, path + ".over", "must be \"worst\", the name of a case, or not be given");
    }
}

}  // namespace

optimizer::Problem read_problem(SectionReader& root, const optimizer::Scene& scene,
                                const optimizer::OptimizerOptions& options, Problems& problems) {
  optimizer::Problem problem;
  std::vector<DesignVariable> variables = read_variables(root, scene, problems);
  const bool accurate = scene.solver.accuracy > 0 || options.verify_accuracy > 0;
  problem.cases = read_cases(root, scene, variables, problems);
  const std::vector<optimizer::LoadCase> named = problem.cases;
  problem.cases = read_samples(root, scene, variables, problem.cases, problem.quantile, problems);
  // Where something is wrong there are no samples yet.
  const bool sampled = (!problems.empty() && root.node() && root.node()->find("uncertain")) ||
                       std::ranges::any_of(problem.cases, [](const auto& load) { return !load.sample_of.empty(); });
  const bool several = sampled || !problem.cases.empty();
  problem.objective = read_objective(root, named, several, accurate, problem.front, problems);
  problem.constraints = read_constraints(root, named, several, accurate, problems);
  refuse_missions(root, scene, problem, sampled, problems);
  const bool varies = root.node() && root.node()->find("variable");
  if (problem.objective.empty() && (varies || (root.node() && root.node()->find("objective"))))
    problems.missing(nullptr, "objective",
                     "is missing; a study with variables needs at least one [[objective]] with a response");
  if (problems.empty()) problem.space = optimizer::DesignSpace(std::move(variables));
  return problem;
}

}  // namespace dovetail::studies
