#include "optimizer/cases.hpp"

#include <algorithm>
#include <string>
#include <vector>

#include "optimizer/candidate/matrices.hpp"
#include "optimizer/responses/response_table.hpp"

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

/// Where nothing wears the mission is at least as uncertain as the case by itself.
void match_unworn(const std::string& load_case, bool plain, Evaluation& result) {
  for (const Response& response : mission_responses()) {
    const std::string name = of_case(response.name, load_case), alone = of_case(response.alone->name, load_case);
    const auto bar = result.error_estimates.find(alone);
    if (bar == result.error_estimates.end() || result.responses.at(of_case(kMissionVolume.name, load_case)) != 0)
      continue;
    double& own = result.error_estimates[name];
    if (own >= bar->second) continue;
    own = bar->second;
    result.error_sources[name] = result.error_sources[alone];
    if (!plain || load_case.empty()) continue;
    result.error_estimates[std::string(response.name)] = own;
    result.error_sources[std::string(response.name)] = result.error_sources[name];
  }
}

/// What a mission came to, for each of its cases and, of the first case, under the plain names.
void add_mission(std::span<const LoadCase> cases, const MissionCases& mission, const Evaluation& there,
                 Evaluation& result) {
  const auto name_of = [&](std::size_t i) { return cases.empty() ? std::string() : cases[i].name; };
  const auto add = [&](const auto& from, auto& to) {
    for (const auto& [key, value] : from) {
      const auto [name, own] = split_case(key);
      for (const std::size_t i : mission.cases) {
        if (!own.empty() && own != name_of(i)) continue;
        to[of_case(name, name_of(i))] = value;
        if (i == 0) to[std::string(name)] = value;
      }
    }
  };
  result.timings_s["mission"] += there.timings_s.contains("total") ? there.timings_s.at("total") : 0;
  add(there.model, result.model);
  const bool sample = !cases.empty() && !cases[mission.cases.front()].sample_of.empty();
  const std::string name = name_of(mission.cases.front()),
                    of = sample ? "Sample " + name.substr(name.rfind('/') + 1) + ": " : "";
  for (const std::string& message : there.messages) result.messages.push_back(of + message);
  if (there.converged()) {
    add(there.responses, result.responses);
    add(there.error_sources, result.error_sources);
    add(there.error_estimates, result.error_estimates);
    for (const std::size_t i : mission.cases) match_unworn(name_of(i), i == 0, result);
  } else if (result.converged() && mission.named) {
    result.status = failed_at("mission", there.status);
  } else if (result.converged()) {
    result.messages.push_back(of + "What all cases wear off together is not known: " + there.status + ".");
  }
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

MissionLoads mission_loads(const Scene& scene, std::span<const LoadCase> cases, const MissionCases& mission) {
  if (cases.empty()) return {.all = {{.name = {}, .share = 1, .scene = scene}}};
  MissionLoads loads;
  std::vector<LoadCase> acting;
  for (const std::size_t i : mission.cases) {
    acting.push_back(cases[i]);
    loads.all.push_back({.name = cases[i].name, .share = cases[i].weight, .scene = in_case(scene, cases[i])});
  }
  loads.by_sharing = by_what_they_share(acting);
  return loads;
}

Evaluation together(std::span<const LoadCase> cases, const Scene& scene, std::span<const Evaluation> answers,
                    std::span<const MissionCases> missions) {
  const std::size_t loads = std::max<std::size_t>(cases.size(), 1);
  Evaluation result = answers.front();
  if (!cases.empty()) {
    result.parameters = parameters(scene);
    // Of a look at another mesh those are its own; they are the same in all cases.
    for (const auto& [key, value] : answers.front().parameters)
      if (key.starts_with("mesh.") || key.starts_with("solver.")) result.parameters[key] = value;
    result.status = status_of(Outcome::converged);
    result.messages.clear();
    result.constraints.clear();
    for (std::size_t i = 0; i < std::min(loads, answers.size()); ++i) {
      // Of a shape that is impossible its reason is told alone.
      if (answers[i].infeasible()) result.messages.clear();
      add_case(cases[i].name, answers[i], result);
      if (answers[i].infeasible()) break;
    }
    sum_up(cases, result);
  }
  // Where a case has failed none is counted, whether it was computed or not.
  const bool all = answers.size() >= loads && std::ranges::all_of(answers.first(loads), &Evaluation::converged);
  for (std::size_t i = 0; all && i < missions.size() && loads + i < answers.size(); ++i)
    add_mission(cases, missions[i], answers[loads + i], result);
  return result;
}

Evaluation evaluated_in_cases(std::span<const LoadCase> cases, const Scene& scene, const CaseEvaluator& evaluate,
                              std::span<const MissionCases> missions, const MissionEvaluator& evaluate_mission) {
  const std::size_t loads = std::max<std::size_t>(cases.size(), 1);
  std::vector<Evaluation> answers(loads);
  if (cases.empty()) {
    answers[0] = evaluate(scene, 0);
  } else {
    for (const std::size_t load : by_what_they_share(cases)) {
      answers[load] = evaluated_or_refused([&] { return evaluate(in_case(scene, cases[load]), load); });
      if (load == 0 && answers[0].infeasible()) return together(cases, scene, std::span(answers).first(1));
    }
  }
  if (std::ranges::all_of(answers, &Evaluation::converged))
    for (std::size_t i = 0; i < missions.size(); ++i)
      answers.push_back(evaluated_or_refused([&] { return evaluate_mission(missions[i], loads + i); }));
  return together(cases, scene, answers, missions);
}

}  // namespace dovetail::optimizer
