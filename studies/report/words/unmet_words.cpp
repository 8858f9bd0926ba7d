#include "studies/report/words/unmet_words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <utility>

#include "studies/report/words/report_words.hpp"

namespace dovetail::report {

namespace {

std::string missed(const std::string& what, std::int64_t candidate, double by) {
  return fmt::format("{} (candidate {} comes nearest and misses it by {}\u00a0%)", what, candidate + 1,
                     significant(100 * by, 2));
}

double largest(const Numbers& constraints) {
  return constraints.empty() ? kInfinity : std::ranges::max(constraints);
}

std::string mesh_words(const FinerRecord& check) {
  return check.flank_elements > 0 ? fmt::format("with {} edges along each flank", check.flank_elements)
                                  : std::string("on a finer mesh");
}

/// The broken ones among `constraints`, `where` said behind the name of each.
std::vector<std::string> broken_limits(const RunRecord& record, const Numbers& constraints, std::int64_t candidate,
                                       const std::string& where) {
  const std::vector<std::string> names = constraint_names(record.problem);
  std::vector<std::string> found;
  for (std::size_t j = 0; j < std::min(names.size(), constraints.size()); ++j)
    if (constraints[j] > 0)
      found.push_back(missed(limit_words(names[j], record.problem) + " " + where, candidate, constraints[j]));
  return found;
}

/// Of a run whose candidates keep every limit on the mesh of the search: what they do not keep on finer ones.
std::vector<std::string> never_kept_on_finer_meshes(const RunRecord& record) {
  const FinerRecord *nearest = nullptr, *unknown = nullptr;
  for (const FinerRecord& check : record.finer) {
    if (!optimizer::converged(check.status))
      unknown = &check;
    else if (largest(check.constraints) > 0 &&
             (nearest == nullptr || largest(check.constraints) < largest(nearest->constraints)))
      nearest = &check;
  }
  if (nearest != nullptr) return broken_limits(record, nearest->constraints, nearest->evaluation, mesh_words(*nearest));
  if (unknown == nullptr) return {};
  return {fmt::format("its limits {}, where candidate {} has no answer ({})", mesh_words(*unknown),
                      unknown->evaluation + 1, unknown->status)};
}

/// Of a run whose looks at finer meshes all held: what the others do not keep with what those looks change in limits.
std::vector<std::string> never_kept_corrected(const RunRecord& record) {
  Numbers changes(constraint_names(record.problem).size(), 0.0);
  for (const FinerRecord& check : record.finer) {
    const auto candidate = static_cast<std::size_t>(check.evaluation);
    if (candidate >= record.evaluations.size()) continue;
    const Numbers& there = check.constraints;
    const Numbers& here = record.evaluations[candidate].constraints;
    for (std::size_t j = 0; j < std::min({changes.size(), here.size(), there.size()}); ++j)
      changes[j] = std::max(changes[j], there[j] - here[j]);
  }
  Numbers nearest;
  std::size_t candidate = 0;
  for (std::size_t i = 0; i < record.evaluations.size(); ++i) {
    Numbers corrected = record.evaluations[i].constraints;
    if (!record.evaluations[i].feasible || corrected.size() != changes.size()) continue;
    std::ranges::transform(corrected, changes, corrected.begin(), std::plus<>());
    if (!(largest(corrected) < largest(nearest))) continue;
    nearest = std::move(corrected);
    candidate = i;
  }
  return broken_limits(record, nearest, static_cast<std::int64_t>(candidate), "with what a finer mesh adds to it");
}

}  // namespace

std::string why_none(const RunRecord& record) {
  std::map<std::string, std::size_t> ends;
  for (const EvaluationRecord& evaluation : record.evaluations) {
    if (const auto how = optimizer::outcome_of(evaluation.status);
        how == optimizer::Outcome::converged || how == optimizer::Outcome::infeasible)
      return {};
    ++ends[evaluation.status];
  }
  if (ends.empty()) return {};
  const auto& [status, count] = *std::ranges::max_element(ends, {}, [](const auto& end) { return end.second; });
  return fmt::format("{} in {} of {}", status, count, record.evaluations.size());
}

std::vector<std::string> never_kept(const RunRecord& record) {
  // The least a limit or a rule is broken by, and where.
  struct Least {
    double c = kInfinity;
    std::size_t candidate = 0;
    void add(double value, std::size_t of) {
      if (value < c) *this = {.c = value, .candidate = of};
    }
  };
  const std::vector<std::string> names = constraint_names(record.problem);
  std::vector<Least> limits(names.size());
  std::map<std::string, Least> rules;
  for (std::size_t i = 0; i < record.evaluations.size(); ++i) {
    const EvaluationRecord& evaluation = record.evaluations[i];
    for (std::size_t j = 0; j < std::min(names.size(), evaluation.constraints.size()); ++j)
      if (std::isfinite(evaluation.constraints[j])) limits[j].add(evaluation.constraints[j], i);
    for (const auto& [name, c] : evaluation.rules) rules[name].add(c, i);
  }
  std::vector<std::string> found;
  const auto tell = [&](const std::string& what, const Least& least) {
    if (std::isfinite(least.c) && least.c > 0)
      found.push_back(missed(what, static_cast<std::int64_t>(least.candidate), least.c));
  };
  for (std::size_t j = 0; j < names.size(); ++j) tell(limit_words(names[j], record.problem), limits[j]);
  for (const auto& [name, least] : rules) tell("the geometric rule \u201c" + words(name) + "\u201d", least);
  if (!found.empty() || record.best) return found;
  found = never_kept_on_finer_meshes(record);
  return found.empty() && !record.finer.empty() ? never_kept_corrected(record) : found;
}

}  // namespace dovetail::report
