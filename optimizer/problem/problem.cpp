#include "optimizer/problem/problem.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <limits>
#include <numeric>
#include <string_view>
#include <tuple>

#include "core/errors.hpp"
#include "core/options.hpp"

namespace dovetail::optimizer {

namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

using Values = std::map<std::string, double>;

double value_of(const Values& values, const std::string& name) {
  const auto found = values.find(name);
  return found == values.end() ? kNaN : found->second;
}

Barred times(double factor, Barred number) {
  return {.value = factor * number.value, .bar = std::abs(factor) * number.bar};
}

/// `factor` times what `size` makes of a response, over all cases: larger ones are worse.
template <class Size>
Barred over_all(const Problem& problem, const std::string& response, const std::string& over, double factor,
                const Values& responses, const Values& bars, const Size& size) {
  const auto in = [&](std::string_view load_case) {
    const std::string name = of_case(response, load_case);
    return Barred{.value = size(value_of(responses, name)), .bar = value_of(bars, name)};
  };
  if (problem.cases.empty()) return times(factor, in({}));
  // How far numbers scatter is the same whichever of them are worse.
  const bool scatter = over == to_string(Over::deviation);
  std::vector<Barred> numbers;
  for (const LoadCase& each : problem.cases) numbers.push_back(times(scatter ? 1 : factor, in(each.name)));
  return times(scatter ? factor : 1, over_cases(over, problem.cases, numbers, problem.quantile));
}

double scale_of(const ObjectiveTerm& term) {
  return term.scale > 0 ? term.scale : 1.0;
}

double size_in(const ObjectiveTerm& term, double response) {
  return term.absolute ? std::abs(response - term.target) : response;
}

/// The number that stands for all terms, or for all their bars.
double total(const Problem& problem, const std::vector<double>& terms) {
  if (problem.front) return terms.empty() ? 0.0 : terms.front();
  return std::accumulate(terms.begin(), terms.end(), 0.0);
}

/// One side of a ResponseConstraint: c = sign (r - limit)/scale.
struct Limit {
  const ResponseConstraint* of;
  double limit, scale, sign;
  [[nodiscard]] std::string name() const {
    const bool by_worst = of->over == to_string(Over::worst);
    return of_case(of->response, by_worst ? "" : of->over) + (sign > 0 ? ":upper" : ":lower");
  }
  [[nodiscard]] Barred value(const Problem& problem, const Values& responses, const Values& bars) const {
    const auto [r, bar] = over_all(problem, of->response, of->over, sign, responses, bars,
                                   [this](double value) { return of->absolute ? std::abs(value) : value; });
    return {.value = (r - sign * limit) / scale, .bar = bar / scale};
  }
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

/// What of an evaluation answers for a response: in every case, or in the one.
std::vector<std::string> answers_of(const Problem& problem, const std::string& response) {
  if (problem.cases.empty()) return {response};
  std::vector<std::string> names;
  for (const LoadCase& each : problem.cases) names.push_back(of_case(response, each.name));
  return names;
}

/// Of all cases the worst; where one has no margin the design has none.
void add_tie_breaks(const Problem& problem, const Evaluation& evaluation, Judgement& judgement) {
  double margin = std::numeric_limits<double>::infinity();
  for (const std::string& name : answers_of(problem, kSlipMargin)) {
    const double here = value_of(evaluation.model, name);
    margin = std::min(margin, std::isfinite(here) ? here : Judgement{}.slip_margin);
  }
  judgement.slip_margin = margin;
  for (const std::string& name : answers_of(problem, "peak_amplitude_m"))
    if (const double here = value_of(evaluation.responses, name); std::isfinite(here))
      judgement.amplitude = std::max(judgement.amplitude, here);
}

std::vector<Violation> violations_of_terms(const Problem& problem) {
  std::vector<Violation> found;
  const auto wrong = [&](std::string key, std::string value, std::string allowed) {
    found.push_back({.file = {}, .key = std::move(key), .value = std::move(value), .allowed = std::move(allowed)});
  };
  for (const ObjectiveTerm& term : problem.objective) {
    const std::string at = "objective." + term.response;
    if (term.response.empty()) wrong("objective.response", "", "must name a response");
    if (!std::isfinite(term.target)) wrong(at + ".aim", shortest(term.target), kAnyNumber.phrase());
    if (!std::isfinite(term.weight) || term.weight == 0)
      wrong(at + ".weight", shortest(term.weight), "must be a finite number other than 0");
    if (!(std::isfinite(term.scale) && term.scale >= 0)) wrong(at + ".scale", shortest(term.scale), kPositive.phrase());
    if (term.reference && !std::isfinite(*term.reference))
      wrong(at + ".reference", shortest(*term.reference), kAnyNumber.phrase());
    if (term.scale == 0 && problem.objective.size() > 1 && !problem.front)
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
  if (problem.front && problem.objective.size() == 1) none("objective", "must name several responses for a front");
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

bool better(const Judgement& one, const Judgement& other) {
  const auto rank = [](const Judgement& j) { return std::tuple{j.objective, -j.slip_margin, j.amplitude}; };
  return rank(one) < rank(other);
}

Judgement judge(const Problem& problem, const Evaluation& evaluation, double tolerance,
                std::span<const double> shifts) {
  Judgement judgement;
  bool finite = evaluation.converged();
  add_tie_breaks(problem, evaluation, judgement);
  for (const ObjectiveTerm& term : problem.objective) {
    judgement.terms.push_back(term_value(problem, term, evaluation.responses, {}).value);
    finite = finite && std::isfinite(judgement.terms.back());
  }
  judgement.objective = total(problem, judgement.terms);
  for (const Limit& limit : limits(problem)) {
    judgement.constraints.push_back(limit.value(problem, evaluation.responses, {}).value);
    finite = finite && std::isfinite(judgement.constraints.back());
  }
  judgement.computed = finite;
  bool met = finite;
  if (!finite) {
    judgement.objective = kNaN;
    std::fill(judgement.terms.begin(), judgement.terms.end(), kNaN);
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

double as_term(const ObjectiveTerm& term, double response) {
  return term.weight * size_in(term, response) / scale_of(term);
}

Barred term_value(const Problem& problem, const ObjectiveTerm& term, const Values& responses, const Values& bars) {
  const double scale = scale_of(term);
  const auto [value, bar] = over_all(problem, term.response, term.over, term.weight, responses, bars,
                                     [&](double r) { return size_in(term, r); });
  return {.value = value / scale, .bar = bar / scale};
}

Barred as_response(const ObjectiveTerm& term, Barred value) {
  return times((term.scale > 0 ? term.scale : 1) / term.weight, value);
}

std::vector<CaseNumber> numbers_asked(const Problem& problem, const Values& responses, const Values& bars) {
  std::vector<CaseNumber> all;
  const auto add = [&](const auto& of, bool absolute, double target, double sense) {
    const auto number = [&](std::string_view over, double aim) {
      const auto size = [&](double r) { return absolute ? std::abs(r - aim) : r; };
      return times(sense, over_all(problem, of.response, std::string(over), sense, responses, bars, size));
    };
    // Also what counts by its distance from a target is known as well as its bar is small beside itself.
    const bool deviates = of.over == to_string(Over::deviation);
    const Barred beside = number(deviates ? to_string(Over::mean) : of.over, 0);
    all.push_back({.name = of_case(of.response, of.over == to_string(Over::worst) ? "" : of.over),
                   .response = of.response,
                   .number = number(of.over, target),
                   .size = std::abs(beside.value)});
  };
  for (const ObjectiveTerm& term : problem.objective) add(term, term.absolute, term.target, term.weight > 0 ? 1 : -1);
  for (const Limit& limit : limits(problem)) add(*limit.of, limit.of->absolute, 0, limit.sign);
  return all;
}

JudgementBars judgement_bars(const Problem& problem, const Values& responses, const Values& error_estimates) {
  JudgementBars bars;
  for (const ObjectiveTerm& term : problem.objective)
    bars.terms.push_back(term_value(problem, term, responses, error_estimates).bar);
  bars.objective = total(problem, bars.terms);
  for (const Limit& limit : limits(problem))
    bars.constraints.push_back(limit.value(problem, responses, error_estimates).bar);
  return bars;
}

void annotate(const Problem& problem, double tolerance, Evaluation& evaluation) {
  if (evaluation.converged()) {
    std::vector<std::string> names;
    for (const std::string& name : responses_of(problem))
      std::ranges::move(answers_of(problem, name), std::back_inserter(names));
    for (const std::string& name : names) {
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
  const JudgementBars bars = judgement_bars(problem, evaluation.responses, evaluation.error_estimates);
  const auto unbounded = [&](const std::string& name) {
    return std::ranges::find(evaluation.unbounded, name) != evaluation.unbounded.end();
  };
  for (std::size_t j = 0; judgement.computed && j < all.size(); ++j)
    if (std::abs(judgement.constraints[j]) < bars.constraints[j] ||
        std::ranges::any_of(answers_of(problem, all[j].of->response), unbounded))
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
