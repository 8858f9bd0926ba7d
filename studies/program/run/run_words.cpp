#include "studies/program/run/run_words.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "studies/program/run/finished_run.hpp"
#include "studies/program/run/run_front.hpp"
#include "studies/program/run/search_progress.hpp"
#include "studies/report/words/report_words.hpp"
#include "studies/report/words/unmet_words.hpp"

namespace dovetail::studies {

using optimizer::OptimizationResult;

namespace {

std::string with_bar(double value, double bar, const char* unit = "") {
  return std::isfinite(bar) ? fmt::format("{:.4g} +- {:.2g}{}", value, bar, unit)
                            : fmt::format("{:.6g}{}", value, unit);
}

/// How far the best design stays from its limits, in per cent of them, here and on finer meshes.
std::string limits_kept(const report::RunRecord& record) {
  std::string text;
  const std::vector<std::string> names = constraint_names(record.problem);
  const report::EvaluationRecord& best = record.evaluations[*record.best];
  const optimizer::JudgementBars bars = judgement_bars(record.problem, best.responses, best.error_estimates);
  for (std::size_t j = 0; j < names.size(); ++j) {
    std::string finer;
    for (const report::FinerRecord& check : record.finer)
      if (check.evaluation == static_cast<std::int64_t>(*record.best))
        finer += fmt::format(", {:.3g} % on {} edges", 0.0 - 100 * check.constraints[j], check.flank_elements);
    const double room = 0.0 - 100 * best.constraints[j], bar = 100 * bars.constraints[j];
    text += fmt::format("  {} {} by {} of its limit{}{}\n", names[j], room < 0 ? "broken" : "kept",
                        with_bar(std::abs(room), bar, " %"), finer, std::abs(room) < bar ? ": undecided" : "");
  }
  return text;
}

/// "; none keeps A and B", or nothing.
std::string listed_unkept(const report::RunRecord& record) {
  const std::vector<std::string> never = words_of(report::never_kept(record));
  return never.empty() ? "" : fmt::format("; none keeps {}", fmt::join(never, ", nor "));
}

/// "; nearest is evaluation 12, which breaks ...", or nothing.
std::string nearest_words(const Study& study, const OptimizationResult& result) {
  if (!result.least_broken) return {};
  const optimizer::Candidate& nearest = result.evaluations[*result.least_broken];
  const std::string broken = broken_words(study.problem, nearest.evaluation, nearest.judgement.constraints);
  if (broken.empty()) return {};
  return fmt::format("; nearest to one is evaluation {}: {}", *result.least_broken + 1, broken);
}

}  // namespace

std::string conclusion(const Study& study, const OptimizationResult& result, const report::RunRecord& record,
                       const std::filesystem::path& directory) {
  const optimizer::SearchStatistics& counts = result.statistics;
  const auto all = static_cast<int>(result.evaluations.size());
  const auto count = [&](const auto& of) { return static_cast<int>(std::ranges::count_if(result.evaluations, of)); };
  const int feasible = count([](const optimizer::Candidate& c) { return c.judgement.feasible; });
  const int failed =
      count([](const optimizer::Candidate& c) { return !c.evaluation.converged() && !c.evaluation.infeasible(); });
  const auto unknown = std::ranges::count_if(
      result.finer, [](const optimizer::FinerCheck& check) { return !check.held && !check.evaluation.converged(); });
  std::string text = fmt::format(
      "{}: {}, {} of them stored before; {} feasible, {} break a limit or a rule{}, {} failed; {}\n", study.name,
      report::counted(result.evaluations.size(), "evaluation"), counts.replayed, feasible, all - feasible - failed,
      unknown == 0 ? ""
                   : fmt::format(" or have no answer on a finer mesh ({})",
                                 report::counted(static_cast<std::size_t>(unknown), "look")),
      failed, result.message.empty() ? std::string(to_string(result.status)) : result.message);
  if (counts.unused_records > 0)
    text += fmt::format("{} stored evaluations were not asked for again: this search took another way\n",
                        counts.unused_records);
  if (!result.best) return text;
  const auto objective = [&](const report::EvaluationRecord& of) {
    if (!std::isfinite(of.objective)) return "not computed (" + of.status + ")";
    return with_bar(of.objective, judgement_bars(record.problem, of.responses, of.error_estimates).objective);
  };
  if (record.front)
    text +=
        front_words(record) + fmt::format("compromise, nearest to the best of each: evaluation {}\n", *result.best + 1);
  else
    text += fmt::format("best objective {} (evaluation {}), start {}\n", objective(record.evaluations[*record.best]),
                        *result.best + 1, objective(record.evaluations.front()));
  for (const auto& [key, value] : variable_values(study, result.evaluations[*result.best]))
    text += fmt::format("  {} = {:.6g}\n", key, value);
  return text + limits_kept(record) + written_to(directory.string());
}

std::string verified_words(const std::vector<report::VerificationRecord>& verifications) {
  std::string text;
  for (const report::VerificationRecord& v : verifications) {
    const auto known = [](bool is, double volume) { return is ? fmt::format("{:.6g} m^3", volume) : "not known"; };
    text += fmt::format("evaluation {}{} by its wear history: {}, directly {:.6g} m^3, on {} {} ({})\n",
                        v.evaluation + 1, v.load_case.empty() ? "" : " in case " + v.load_case,
                        known(v.history_known(), v.history_volume_m3), v.search_volume_m3,
                        v.flank_elements > 0 ? fmt::format("{} edges", v.flank_elements) : "a finer mesh",
                        known(v.finer_known(), v.direct_volume_m3), v.agreement());
  }
  return text;
}

std::string held_words(const report::RunRecord& record) {
  std::string broken;
  std::size_t all = 0, kept = 0;
  for (const report::DepartureRecord& there : record.departures) {
    if (!record.best || there.evaluation != static_cast<std::int64_t>(*record.best)) continue;
    ++all;
    const bool keeps =
        optimizer::converged(there.status) && std::ranges::all_of(there.constraints, [](double c) { return c <= 0; });
    kept += keeps ? 1 : 0;
    if (!keeps) broken += (broken.empty() ? "; not with " : ", ") + there.departure;
  }
  return all == 0 ? "" : fmt::format("keeps its limits in {} of {} other conditions{}\n", kept, all, broken);
}

std::string shortcoming(const Study& study, const OptimizationResult& result, const WrittenRun& written) {
  const report::RunRecord& record = written.record;
  if (const std::string why = report::why_none(record); !result.best && !why.empty())
    return fmt::format("{}: none of {} could be computed: {}", study.file,
                       report::counted(result.evaluations.size(), "evaluation"), why);
  if (!result.best)
    return fmt::format("{}: no feasible design was found in {}{}{}", study.file,
                       report::counted(result.evaluations.size(), "evaluation"), listed_unkept(record),
                       nearest_words(study, result));
  const bool stands = !record.best_design || optimizer::converged(record.best_design->status);
  if (!stands || !record.evaluations[*result.best].feasible)
    return fmt::format("the best design, evaluation {}, looked at with bars and its wear history: {}", *result.best + 1,
                       stands ? "breaks a limit" : record.best_design->status);
  for (const report::VerificationRecord& v : record.verifications)
    if (v.evaluation == static_cast<std::int64_t>(*result.best) && !optimizer::converged(v.status))
      return fmt::format("the verification of the best design, evaluation {}: {}", v.evaluation + 1, v.status);
  if (!written.inaccurate.empty())
    return fmt::format(
        "the best design, evaluation {}: {}{}", *result.best + 1, written.inaccurate,
        study.optimizer.verify_accuracy > 0
            ? ""
            : " (settings were chosen before the search; [optimizer] verify_accuracy has them chosen at the "
              "best design, too)");
  return {};
}

}  // namespace dovetail::studies
