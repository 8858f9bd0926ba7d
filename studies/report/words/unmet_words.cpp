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

/// Of what candidates keep on the mesh of the search: the limits that no look at a finer one keeps, each where it is
/// missed by least.
std::vector<Unkept> never_kept_in(const RunRecord& record, const std::vector<const FinerRecord*>& looks) {
  const std::vector<std::string> names = constraint_names(record.problem);
  std::vector<Unkept> found;
  for (std::size_t j = 0; j < names.size() && !looks.empty(); ++j) {
    const FinerRecord& nearest =
        **std::ranges::min_element(looks, {}, [j](const FinerRecord* look) { return look->constraints[j]; });
    const std::string limit = limit_words(names[j], record.problem);
    if (nearest.constraints[j] > 0)
      found.push_back({.limit = limit,
                       .words = missed(limit + " " + mesh_words(nearest), nearest.evaluation, nearest.constraints[j])});
  }
  if (!found.empty()) return found;
  for (const FinerRecord* look : looks)
    for (std::size_t j = 0; j < names.size(); ++j)
      if (look->constraints[j] > 0)
        return {{.limit = {},
                 .words = fmt::format("all limits at once on finer meshes ({} candidate {} breaks {})",
                                      mesh_words(*look), look->evaluation + 1, limit_words(names[j], record.problem))}};
  return {};
}

/// What looks that all held change in limits, and the candidate that comes nearest to keep them so.
std::vector<Unkept> never_kept_corrected(const RunRecord& record) {
  const std::vector<std::string> names = constraint_names(record.problem);
  Numbers changes(names.size(), 0.0);
  for (const FinerRecord& check : record.finer) {
    const Numbers& here = record.evaluations[static_cast<std::size_t>(check.evaluation)].constraints;
    for (std::size_t j = 0; j < std::min({changes.size(), here.size(), check.constraints.size()}); ++j)
      if (const double change = check.constraints[j] - here[j]; change > changes[j]) changes[j] = change;
  }
  Numbers nearest;
  std::size_t candidate = 0;
  for (std::size_t i = 0; i < record.evaluations.size(); ++i) {
    Numbers corrected = record.evaluations[i].constraints;
    if (!keeps_all(record.evaluations[i]) || corrected.size() != changes.size() || changes.empty()) continue;
    std::ranges::transform(corrected, changes, corrected.begin(), std::plus<>());
    if (!nearest.empty() && std::ranges::max(corrected) >= std::ranges::max(nearest)) continue;
    nearest = std::move(corrected);
    candidate = i;
  }
  std::vector<Unkept> found;
  for (std::size_t j = 0; j < nearest.size(); ++j) {
    const std::string limit = limit_words(names[j], record.problem);
    if (nearest[j] > 0)
      found.push_back({.limit = limit,
                       .words = missed(limit + " with what a finer mesh adds to it",
                                       static_cast<std::int64_t>(candidate), nearest[j])});
  }
  return found;
}

/// Of a run with candidates that keep every limit on the mesh of the search: what they do not keep on finer ones.
std::vector<Unkept> never_kept_on_finer_meshes(const RunRecord& record) {
  std::vector<const FinerRecord*> looks;
  const FinerRecord* unknown = nullptr;
  for (const FinerRecord& check : record.finer) {
    if (!keeps_all(record.evaluations[static_cast<std::size_t>(check.evaluation)])) continue;
    if (optimizer::converged(check.status) && check.constraints.size() == constraint_names(record.problem).size())
      looks.push_back(&check);
    else
      unknown = &check;
  }
  if (std::vector<Unkept> found = never_kept_in(record, looks); !found.empty()) return found;
  if (unknown != nullptr)
    return {{.limit = {},
             .words = fmt::format("its limits {}, where candidate {} has no answer ({})", mesh_words(*unknown),
                                  unknown->evaluation + 1, unknown->status)}};
  return never_kept_corrected(record);
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

std::vector<Unkept> never_kept(const RunRecord& record) {
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
  std::vector<Unkept> found;
  const auto tell = [&](const std::string& what, const Least& least) {
    if (std::isfinite(least.c) && least.c > 0)
      found.push_back({.limit = what, .words = missed(what, static_cast<std::int64_t>(least.candidate), least.c)});
  };
  for (std::size_t j = 0; j < names.size(); ++j) tell(limit_words(names[j], record.problem), limits[j]);
  for (const auto& [name, least] : rules) tell("the geometric rule \u201c" + words(name) + "\u201d", least);
  // Each limit may be kept by some, and all of them by none: no finer mesh is to blame then.
  if (!found.empty() || record.best || std::ranges::none_of(record.evaluations, keeps_all)) return found;
  return never_kept_on_finer_meshes(record);
}

std::vector<std::string> words_of(const std::vector<Unkept>& unkept) {
  std::vector<std::string> words;
  for (const Unkept& one : unkept) words.push_back(one.words);
  return words;
}

}  // namespace dovetail::report
