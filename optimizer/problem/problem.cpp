#include "optimizer/problem/problem.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>

#include "core/errors.hpp"
#include "core/options.hpp"

namespace dovetail::optimizer {

namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// One side of a ResponseConstraint: c = sign (r - limit)/scale.
struct Limit {
  const ResponseConstraint* of;
  double limit, scale, sign;
  [[nodiscard]] std::string name() const { return of->response + (sign > 0 ? ":upper" : ":lower"); }
};

std::vector<Limit> limits(const Problem& problem) {
  std::vector<Limit> all;
  for (const ResponseConstraint& c : problem.constraints) {
    const auto add = [&](double limit, double sign) {
      all.push_back({.of = &c, .limit = limit, .scale = c.scale_at(limit), .sign = sign});
    };
    if (c.upper) add(*c.upper, 1);
    if (c.lower) add(*c.lower, -1);
  }
  return all;
}

double scale_of(const ObjectiveTerm& term) {
  return term.scale > 0 ? term.scale : 1.0;
}

double response(const Evaluation& evaluation, const std::string& name, bool absolute) {
  const auto found = evaluation.responses.find(name);
  if (found == evaluation.responses.end()) return kNaN;
  return absolute ? std::abs(found->second) : found->second;
}

std::vector<Violation> violations_of_terms(const Problem& problem) {
  std::vector<Violation> found;
  const auto wrong = [&](std::string key, std::string value, std::string allowed) {
    found.push_back({.file = {}, .key = std::move(key), .value = std::move(value), .allowed = std::move(allowed)});
  };
  for (const ObjectiveTerm& term : problem.objective) {
    const std::string at = "objective." + term.response;
    if (term.response.empty()) wrong("objective.response", "", "must name a response");
    if (!std::isfinite(term.weight) || term.weight == 0)
      wrong(at + ".weight", shortest(term.weight), "must be a finite number other than 0");
    if (!(std::isfinite(term.scale) && term.scale >= 0)) wrong(at + ".scale", shortest(term.scale), kPositive.phrase());
    if (term.scale == 0 && problem.objective.size() > 1)
      wrong(at + ".scale", "0", "must be given (> 0, in the response's unit) when the objective has several terms");
  }
  for (const ResponseConstraint& c : problem.constraints) {
    const std::string at = "constraints." + c.response;
    if (c.response.empty()) wrong("constraints.response", "", "must name a response");
    if (!c.lower && !c.upper) wrong(at, "no limit", "must give lower, upper or both");
    if (!(std::isfinite(c.scale) && c.scale >= 0)) wrong(at + ".scale", shortest(c.scale), kPositive.phrase());
    for (const auto& [limit, side] : {std::pair{c.lower, ".lower"}, std::pair{c.upper, ".upper"}}) {
      if (!limit) continue;
      if (!std::isfinite(*limit)) wrong(at + side, shortest(*limit), kAnyNumber.phrase());
      if (*limit == 0 && c.scale == 0) wrong(at + ".scale", "0", "must be given (> 0) because a limit is 0");
    }
    if (c.lower && c.upper && *c.lower > *c.upper)
      wrong(at + ".lower", shortest(*c.lower), "must be <= upper = " + shortest(*c.upper));
  }
  const std::vector<std::string> names = constraint_names(problem);
  for (std::size_t i = 0; i < names.size(); ++i)
    if (std::find(names.begin() + static_cast<std::ptrdiff_t>(i) + 1, names.end(), names[i]) != names.end())
      wrong("constraints", names[i], "must limit a response only once on each side");
  return found;
}

}  // namespace

void check_terms(const Problem& problem) {
  if (std::vector<Violation> found = violations_of_terms(problem); !found.empty()) throw InputError(std::move(found));
}

void check(const Problem& problem) {
  std::vector<Violation> found;
  const auto none = [&](const char* key, const char* allowed) {
    found.push_back({.file = {}, .key = key, .value = "none", .allowed = allowed});
  };
  if (problem.space.size() == 0) none("variables", "must name at least one design variable");
  if (problem.objective.empty()) none("objective", "must name at least one response");
  for (Violation& wrong : violations_of_terms(problem)) found.push_back(std::move(wrong));
  if (!found.empty()) throw InputError(std::move(found));
}

std::vector<std::string> responses_of(const Problem& problem) {
  std::vector<std::string> names;
  const auto add = [&names](const std::string& name) {
    if (std::ranges::find(names, name) == names.end()) names.push_back(name);
  };
  for (const ObjectiveTerm& term : problem.objective) add(term.response);
  for (const ResponseConstraint& c : problem.constraints) add(c.response);
  return names;
}

std::vector<std::string> constraint_names(const Problem& problem) {
  std::vector<std::string> names;
  for (const Limit& limit : limits(problem)) names.push_back(limit.name());
  return names;
}

Judgement judge(const Problem& problem, const Evaluation& evaluation, double tolerance,
                std::span<const double> shifts) {
  Judgement judgement;
  bool finite = evaluation.converged();
  for (const ObjectiveTerm& term : problem.objective)
    judgement.objective += term.weight * response(evaluation, term.response, term.absolute) / scale_of(term);
  finite = finite && std::isfinite(judgement.objective);
  for (const Limit& limit : limits(problem)) {
    const double r = response(evaluation, limit.of->response, limit.of->absolute);
    judgement.constraints.push_back(limit.sign * (r - limit.limit) / limit.scale);
    finite = finite && std::isfinite(judgement.constraints.back());
  }
  judgement.computed = finite;
  bool met = finite;
  if (!finite) {
    judgement.objective = kNaN;
    std::fill(judgement.constraints.begin(), judgement.constraints.end(), kNaN);
  } else {
    for (std::size_t j = 0; j < judgement.constraints.size(); ++j) {
      const double c = judgement.constraints[j] + (shifts.empty() ? 0 : shifts[j]);
      judgement.violation += std::max(0.0, c);
      met = met && c <= tolerance;
    }
  }
  for (const auto& [name, value] : evaluation.constraints) {
    if (!std::string_view(name).starts_with(kRulePrefix)) continue;
    // A rule that could not be measured is taken as broken by its whole normalisation.
    const double c = std::isfinite(value) ? value : 1.0;
    if (c != 0) judgement.rules = std::max(judgement.rules.value_or(c), c);
    judgement.violation += std::max(0.0, c);
    met = met && c <= tolerance;
  }
  if (evaluation.infeasible() && judgement.rules.value_or(0.0) <= 0) {
    judgement.rules = 1.0;
    judgement.violation += 1.0;
  }
  judgement.feasible = met;
  return judgement;
}

JudgementBars judgement_bars(const Problem& problem, const std::map<std::string, double>& error_estimates) {
  const auto bar = [&](const std::string& response) {
    const auto found = error_estimates.find(response);
    return found == error_estimates.end() ? kNaN : found->second;
  };
  JudgementBars bars;
  for (const ObjectiveTerm& term : problem.objective)
    bars.objective += std::abs(term.weight) * bar(term.response) / scale_of(term);
  for (const Limit& limit : limits(problem)) bars.constraints.push_back(bar(limit.of->response) / limit.scale);
  return bars;
}

void annotate(const Problem& problem, double tolerance, Evaluation& evaluation) {
  if (evaluation.converged()) {
    for (const std::string& name : responses_of(problem)) {
      const auto found = evaluation.responses.find(name);
      if (found != evaluation.responses.end() && std::isfinite(found->second)) continue;
      evaluation.status =
          failed_at("response", name + (found == evaluation.responses.end() ? " is missing" : " is not finite"));
      break;
    }
  }
  const Judgement judgement = judge(problem, evaluation, tolerance);
  const std::vector<std::string> names = constraint_names(problem);
  for (std::size_t j = 0; j < names.size(); ++j)
    if (judgement.computed) evaluation.constraints[names[j]] = judgement.constraints[j];
  evaluation.feasible = judgement.feasible;
  evaluation.undecided_constraints.clear();
  const std::vector<Limit> all = limits(problem);
  const JudgementBars bars = judgement_bars(problem, evaluation.error_estimates);
  for (std::size_t j = 0; judgement.computed && j < all.size(); ++j)
    if (std::abs(judgement.constraints[j]) < bars.constraints[j] ||
        std::ranges::find(evaluation.unbounded, all[j].of->response) != evaluation.unbounded.end())
      evaluation.undecided_constraints.push_back(names[j]);
}

void require_responses(const Problem& problem, const Evaluation& evaluation) {
  std::vector<std::string> available;
  for (const auto& [name, value] : evaluation.responses) available.push_back(name);
  std::vector<Violation> found;
  for (const std::string& name : responses_of(problem)) {
    if (evaluation.responses.contains(name)) continue;
    const std::string near = nearest(name, available);
    std::string allowed = "is no response of this study";
    if (!near.empty()) allowed += "; did you mean " + near + "?";
    found.push_back({.file = {}, .key = "response", .value = name, .allowed = allowed});
  }
  if (!found.empty()) throw InputError(std::move(found));
}

}  // namespace dovetail::optimizer
