#include "tests/hard_cases/suite.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <exception>
#include <map>
#include <memory>

#include "paths/steady_state.hpp"

namespace dovetail::hard_cases {

Outcome attempt(const Family& family, int index, const Problem& problem, const paths::WayParams& ways) {
  Outcome outcome{.family = family.name,
                  .index = index,
                  .fresh = family.fresh,
                  .has_answer = problem.no_answer.empty(),
                  .contact_mass = problem.contact_mass,
                  .nodes = static_cast<int>(problem.model.contact.count())};
  const auto start = std::chrono::steady_clock::now();
  steady::State state;
  try {
    const auto model = std::make_shared<const dynamics::CondensedModel>(problem.model);
    state = paths::steady_state({model, problem.condition, problem.options}, problem.omega, {}, {}, ways);
  } catch (const std::exception& error) {
    outcome.thrown = error.what();
    return outcome;
  }
  outcome.milliseconds = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
  outcome.status = state.status;
  outcome.iterations = state.iterations;
  outcome.residual = state.residual;
  outcome.penalty_ratio = state.penalty_ratio;
  outcome.way = state.way;
  outcome.unknowns = static_cast<int>(state.displacement.size());
  if (!outcome.converged()) return outcome;
  outcome.claim = {.displacement = state.displacement,
                   .force = state.force,
                   .normal = state.penalty.normal,
                   .tangential = state.penalty.tangential,
                   .input_energy = state.input_energy,
                   .damping_energy = state.damping_energy,
                   .contact_work = state.contact_work};
  outcome.verdict = examine(problem, outcome.claim);
  outcome.wrong = outcome.has_answer ? objection(outcome.verdict) : "there is no such state";
  return outcome;
}

bool chosen_for_spoiling(int index) {
  constexpr int kEvery = 12;
  return index % kEvery == index / kEvery % 2;
}

void spoil(const Problem& problem, const Outcome& outcome, std::vector<Score>& scores) {
  constexpr int kNodes = 8;
  if (!chosen_for_spoiling(outcome.index) || !outcome.converged() || !outcome.has_answer) return;
  if (outcome.contact_mass || outcome.nodes > kNodes) return;
  Random random(outcome.id(), 0);
  spoil(problem, outcome.claim, outcome.verdict, random, scores);
}

namespace {

double median(std::vector<double> values) {
  if (values.empty()) return 0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

// What the columns of the table count, of one family or of several.
struct Line {
  int problems = 0, converged = 0, wrong = 0, thrown = 0, drifting = 0, max_iterations = 0;
  std::map<Status, int> classified;
  std::vector<double> iterations, milliseconds;

  void add(const Outcome& outcome) {
    ++problems;
    milliseconds.push_back(outcome.milliseconds);
    if (!outcome.wrong.empty()) ++wrong;
    if (!outcome.thrown.empty()) ++thrown;
    if (outcome.verdict.drifting > 0) ++drifting;
    if (outcome.converged()) {
      ++converged;
      iterations.push_back(outcome.iterations);
      max_iterations = std::max(max_iterations, outcome.iterations);
    } else if (outcome.thrown.empty()) {
      ++classified[outcome.status];
    }
  }
  [[nodiscard]] std::string print(const std::string& name) const {
    std::string reasons;
    for (const auto& [status, count] : classified)
      reasons += fmt::format("{}{} {}", reasons.empty() ? "" : ", ", count, to_string(status));
    if (thrown > 0) reasons += fmt::format(", {} threw", thrown);
    if (drifting > 0) reasons += fmt::format("{}{} drift at fine steps", reasons.empty() ? "" : ", ", drifting);
    return fmt::format("{:<24}{:>9}{:>11}{:>7}{:>8.0f}{:>6}{:>9.1f}  {}\n", name, problems, converged, wrong,
                       median(iterations), max_iterations, median(milliseconds), reasons.empty() ? "-" : reasons);
  }
};

// The kind of a problem: those whose number of solutions means something are told apart.
std::string_view kind(const Outcome& outcome) {
  if (!outcome.has_answer) return "no steady state exists";
  if (outcome.contact_mass) return "mass on contact nodes";
  return outcome.fresh ? "massless, fresh" : "massless, tuned on";
}

// States that each way led to, and what they took with all ways before it.
std::string ways(const std::vector<Outcome>& outcomes) {
  std::map<steady::Way, std::vector<double>> iterations;
  for (const Outcome& outcome : outcomes)
    if (outcome.converged()) iterations[outcome.way].push_back(outcome.iterations);
  std::string text = fmt::format("\n{:<24}{:>9}{:>14}\n", "way", "states", "iterations");
  for (const auto& [way, taken] : iterations)
    if (way != steady::Way::none)
      text += fmt::format("{:<24}{:>9}{:>14.0f}\n", steady::to_string(way), taken.size(), median(taken));
  return text;
}

}  // namespace

std::string table(const std::vector<Outcome>& outcomes) {
  std::vector<std::string> order;
  std::map<std::string, Line> lines;
  std::map<std::string_view, Line> kinds;
  Line all;
  for (const Outcome& outcome : outcomes) {
    if (!lines.contains(outcome.family)) order.push_back(outcome.family);
    lines[outcome.family].add(outcome);
    kinds[kind(outcome)].add(outcome);
    all.add(outcome);
  }
  std::string text = fmt::format("{:<24}{:>9}{:>11}{:>7}{:>8}{:>6}{:>9}  {}\n", "family", "problems", "converged",
                                 "wrong", "median", "max", "median", "classified");
  text += fmt::format("{:<24}{:>9}{:>11}{:>7}{:>14}{:>9}\n", "", "", "", "", "iterations", "ms");
  for (const std::string& name : order) text += lines.at(name).print(name);
  text += "\n";
  for (const auto& [name, line] : kinds) text += line.print(std::string(name));
  return text + all.print("all") + ways(outcomes);
}

std::string marginal_table(const std::vector<Family>& families, const std::vector<Outcome>& outcomes) {
  struct Yield {
    int earned = 0, lost = 0, gained = 0;
    double with = 0, without = 0;
  };
  std::map<std::pair<steady::Way, std::string_view>, Yield> yields;
  for (const Outcome& outcome : outcomes) {
    const auto family =
        std::find_if(families.begin(), families.end(), [&](const Family& f) { return f.name == outcome.family; });
    const Problem problem = family->make(outcome.index);
    for (int i = static_cast<int>(steady::Way::closed); i < static_cast<int>(steady::Way::none); ++i) {
      const auto way = static_cast<steady::Way>(i);
      const bool same = outcome.way < way;
      const Outcome other = same ? outcome : attempt(*family, outcome.index, problem, {.left_out = way});
      const auto right = [](const Outcome& o) { return o.converged() && o.wrong.empty(); };
      Yield& yield = yields[{way, kind(outcome)}];
      yield.earned += right(outcome) && outcome.way == way ? 1 : 0;
      yield.lost += right(outcome) && !right(other) ? 1 : 0;
      yield.gained += right(other) && !right(outcome) ? 1 : 0;
      yield.with += outcome.iterations;
      yield.without += other.iterations;
    }
  }
  std::string text =
      fmt::format("{:<18}{:<24}{:>8}{:>8}{:>8}{:>18}\n", "way left out", "", "earned", "lost", "gained", "Jacobians");
  for (const auto& [where, yield] : yields)
    text += fmt::format("{:<18}{:<24}{:>8}{:>8}{:>8}{:>8.0f} ->{:>7.0f}\n", steady::to_string(where.first),
                        where.second, yield.earned, yield.lost, yield.gained, yield.with, yield.without);
  return text;
}

namespace {

std::string findings(const Verdict& verdict) {
  std::string text = fmt::format(" rounding {:.1e}", verdict.rounding);
  for (std::size_t i = 0; i < kChecks; ++i)
    text += fmt::format(", {} {:.1e} of {:.1e}", name(static_cast<Check>(i)), verdict.findings[i].found,
                        verdict.findings[i].allowed);
  return text;
}

}  // namespace

std::string failures(const std::vector<Outcome>& outcomes) {
  std::string text;
  for (const Outcome& outcome : outcomes) {
    if (!outcome.wrong.empty())
      text += fmt::format("{:<28} WRONG: {};{}\n", outcome.id(), outcome.wrong, findings(outcome.verdict));
    else if (!outcome.thrown.empty())
      text += fmt::format("{:<28} threw: {}\n", outcome.id(), outcome.thrown);
    else if (!outcome.converged() && outcome.has_answer)
      text += fmt::format("{:<28} {}: {} nodes, {} unknowns, {} iterations, {:.0f} ms, residual {:.1e}\n", outcome.id(),
                          to_string(outcome.status), outcome.nodes, outcome.unknowns, outcome.iterations,
                          outcome.milliseconds, outcome.residual);
  }
  return text;
}

std::string comma_separated(const std::vector<Outcome>& outcomes) {
  std::string text =
      "id,status,nodes,unknowns,iterations,milliseconds,residual,penalty_ratio,check_rounding,check_resolution";
  for (std::size_t i = 0; i < kChecks; ++i) text += fmt::format(",{}", name(static_cast<Check>(i)));
  text += ",wrong\n";
  for (const Outcome& o : outcomes) {
    text +=
        fmt::format("{},{},{},{},{},{:.3f},{:.3e},{},{:.3e},{:.3e}", o.id(),
                    o.thrown.empty() ? std::string(to_string(o.status)) : "threw", o.nodes, o.unknowns, o.iterations,
                    o.milliseconds, o.residual, o.penalty_ratio, o.verdict.rounding, o.verdict.resolution);
    for (const Verdict::Finding& finding : o.verdict.findings)
      text += fmt::format(",{:.2e}", finding.found / std::max(finding.allowed, 1e-300));
    text += fmt::format(",{}\n", o.wrong);
  }
  return text;
}

}  // namespace dovetail::hard_cases
