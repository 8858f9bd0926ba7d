#include "optimizer/cases.hpp"

#include <algorithm>
#include <string>
#include <vector>

#include "optimizer/candidate/matrices.hpp"

namespace dovetail::optimizer {

namespace {

/// Adds what a design came to in a case.
void add_case(const std::string& name, const Evaluation& there, Evaluation& result) {
  const auto add = [&name](const auto& from, auto& to) {
    for (const auto& [key, value] : from) to[of_case(key, name)] = value;
  };
  add(there.responses, result.responses);
  add(there.error_estimates, result.error_estimates);
  add(there.error_sources, result.error_sources);
  add(there.model, result.model);
  add(there.timings_s, result.timings_s);
  for (const std::string& response : there.unbounded) result.unbounded.push_back(of_case(response, name));
  for (const std::string& message : there.messages) result.messages.push_back("Case " + name + ": " + message);
  for (const auto& [rule, value] : there.constraints) {
    const auto [at, is_new] = result.constraints.try_emplace(rule, value);
    if (!is_new) at->second = std::max(at->second, value);
  }
  result.feasible = result.feasible && there.feasible;
  if (result.converged() && !there.converged())
    result.status = there.infeasible() ? there.status : "case " + name + ": " + there.status;
}

/// Entries of all cases as one: the work of all, and a doubt where one has it.
void sum_up(std::span<const LoadCase> cases, Evaluation& result) {
  const auto gather = [&](auto& of, const char* key, auto&& together) {
    double& whole = of[key] = 0;
    for (const LoadCase& load : cases)
      if (const auto found = of.find(of_case(key, load.name)); found != of.end())
        whole = together(whole, found->second);
  };
  const auto sum = [](double a, double b) { return a + b; };
  gather(result.model, "jacobians_spent", sum);
  gather(result.timings_s, "total", sum);
  gather(result.model, "wear_history_may_differ", [](double a, double b) { return std::max(a, b); });
}

}  // namespace

Scene in_case(Scene scene, const LoadCase& load) {
  for (const KeyChange& change : load.changes) {
    const auto set = [&](const std::string& key) {
      const double own = change.times == 0 ? 0 : change.times * parameter(scene, key);
      set_parameter(scene, key, own + change.value);
    };
    // Each flank from its own number.
    const std::vector<std::string> flanks = change.times == 0 ? std::vector<std::string>() : flank_keys(change.key);
    if (flanks.empty()) set(change.key);
    for (const std::string& key : flanks) set(key);
  }
  return scene;
}

Scene in_first_case(const Scene& scene, std::span<const LoadCase> cases) {
  return cases.empty() ? scene : in_case(scene, cases.front());
}

Evaluation together(std::span<const LoadCase> cases, const Scene& scene, std::span<const Evaluation> in_cases) {
  if (cases.empty()) return in_cases.front();
  Evaluation result = in_cases.front();
  result.parameters = parameters(scene);
  result.status = status_of(Outcome::converged);
  result.messages.clear();
  result.constraints.clear();
  for (std::size_t i = 0; i < in_cases.size(); ++i) {
    add_case(cases[i].name, in_cases[i], result);
    if (in_cases[i].infeasible()) break;
  }
  sum_up(cases, result);
  return result;
}

Evaluation evaluated_in_cases(std::span<const LoadCase> cases, const Scene& scene, const CaseEvaluator& evaluate) {
  if (cases.empty()) return evaluate(scene, 0);
  std::vector<Evaluation> in_cases(cases.size());
  std::vector<bool> done(cases.size());
  const auto compute = [&](std::size_t load) {
    if (!done[load]) in_cases[load] = evaluated_or_refused([&] { return evaluate(in_case(scene, cases[load]), load); });
    done[load] = true;
  };
  compute(0);
  if (in_cases[0].infeasible()) return together(cases, scene, std::span(in_cases).first(1));
  for (std::size_t first = 0; first < cases.size(); ++first)
    for (std::size_t load = first; load < cases.size(); ++load)
      if (share_matrices(cases[load], cases[first])) compute(load);
  return together(cases, scene, in_cases);
}

}  // namespace dovetail::optimizer
