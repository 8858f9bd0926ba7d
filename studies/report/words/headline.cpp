#include "studies/report/words/headline.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>
#include <vector>

#include "studies/report/words/report_words.hpp"
#include "studies/report/words/units.hpp"
#include "studies/report/words/unmet_words.hpp"

namespace dovetail::report {

namespace {

/// Is the difference more than both error bars together?
std::string against_errors(double from, double to, double error) {
  if (std::isnan(error)) return "No error bar is known for it.";
  if (std::isinf(error)) return "Its error bar could not be computed.";
  const double change = std::abs(to - from);
  if (!(change > 0) || !(error > 0)) return "";
  if (change <= error)
    return std::string("The change is within the error bars of the two values") +
           (to < from ? ", so it may be no improvement at all." : ": it may be none.");
  const double times = change / error;
  if (times < 3)
    return fmt::format("The change is {} times the error bars of the two values together.", significant(times, 2));
  return fmt::format("The change is far beyond the error bars of the two values ({} times their sum).",
                     times >= 1000 ? std::string("over 1000") : significant(times, times >= 10 ? 2 : 1));
}

std::string verb(double from, double to) {
  return to < from ? "fell" : to > from ? "rose" : "stayed";
}

/// "from 0.31 to 0.02 mm^3 (-94 %)"
std::string from_to(const std::string& response, double from, double to) {
  const Unit unit = response_unit(response, std::max(std::abs(from), std::abs(to)));
  const std::string symbol = unit.symbol.empty() ? "" : "\u00a0" + unit.symbol;
  if (from == to) return "at " + significant(to / unit.si, 3) + symbol;
  std::string text =
      fmt::format("from {} to {}{}", significant(from / unit.si, 3), significant(to / unit.si, 3), symbol);
  if (from > 0 && to > 0) text += " (" + per_cent(to, from, 1, 2) + ")";
  return text;
}

std::string single_term(const RunRecord& record, const EvaluationRecord& base, const EvaluationRecord& best) {
  const optimizer::ObjectiveTerm& term = record.problem.objective.front();
  const optimizer::Barred from = shown_term(record.problem, term, base), to = shown_term(record.problem, term, best);
  const std::string errors = against_errors(from.value, to.value, from.bar + to.bar);
  return fmt::format("The {} {} {}.{}", term_words(record.problem, term), verb(from.value, to.value),
                     from_to(term.response, from.value, to.value), errors.empty() ? "" : " " + errors);
}

std::string several_terms(const RunRecord& record, const EvaluationRecord& base, const EvaluationRecord& best) {
  double error = 0;
  std::vector<std::string> parts;
  for (const optimizer::ObjectiveTerm& term : record.problem.objective) {
    const optimizer::Barred from = shown_term(record.problem, term, base), to = shown_term(record.problem, term, best);
    error += std::abs(term.weight) / (term.scale > 0 ? term.scale : 1) * (from.bar + to.bar);
    parts.push_back(fmt::format("the {} {} {}", term_words(record.problem, term), verb(from.value, to.value),
                                from_to(term.response, from.value, to.value)));
  }
  const std::string errors = against_errors(base.objective, best.objective, error);
  return fmt::format("The objective, a {}, {} from {} to {}: {}.{}", objective_words(record.problem),
                     verb(base.objective, best.objective), significant(base.objective, 3),
                     significant(best.objective, 3), listed(parts), errors.empty() ? "" : " " + errors);
}

std::string objective_value(const RunRecord& record, const EvaluationRecord& best) {
  if (record.problem.objective.size() != 1) return fmt::format("an objective of {}", significant(best.objective, 3));
  const optimizer::ObjectiveTerm& term = record.problem.objective.front();
  const auto [value, bar] = shown_term(record.problem, term, best);
  const std::string said = term_words(record.problem, term);
  const char* article = std::string_view("aeiou").find(said.front()) == std::string_view::npos ? "a" : "an";
  return fmt::format("{} {} of {}", article, said, with_error(value, bar, response_unit(term.response, value)));
}

/// "an asymptotic wear volume of 0.18 mm^3", or the value alone.
std::string objective_of(const RunRecord& record, std::size_t i, double value, bool named) {
  const optimizer::ObjectiveTerm& term = record.problem.objective[i];
  const Unit unit = response_unit(term.response, std::max(std::abs(value), std::abs(record.front->reference[i])));
  std::string text = significant(value / unit.si, 3) + (unit.symbol.empty() ? "" : "\u00a0" + unit.symbol);
  if (!named) return text;
  const std::string name = term_words(record.problem, term);
  return (std::string_view("aeiou").find(name.front()) == std::string_view::npos ? "a " : "an ") + name + " of " + text;
}

/// From the one end of the front to the other, and where the start lies.
std::string front_headline(const RunRecord& record) {
  const FrontRecord& front = *record.front;
  const std::size_t points = front.evaluation.size();
  const auto design = [&](bool named, const auto& value) {
    std::vector<std::string> all;
    for (std::size_t i = 0; i < front.columns(); ++i) all.push_back(objective_of(record, i, value(i), named));
    return listed(all);
  };
  const auto point = [&](std::size_t at) { return [&front, at](std::size_t i) { return front.value(at, i); }; };
  if (points == 1) return "One design is beaten by no other in any objective, with " + design(true, point(0)) + ".";
  std::string text = fmt::format("{} designs that no other beats, from {} to {}.", points, design(true, point(0)),
                                 design(false, point(points - 1)));
  const EvaluationRecord* base = baseline_of(record);
  if (base == nullptr || !std::isfinite(base->objective)) return text;
  const auto start = [&](std::size_t i) {
    return shown_term(record.problem, record.problem.objective[i], *base).value;
  };
  return text + " The start has " + design(false, start) + (base->feasible ? "." : ", and breaks a limit.");
}

/// What speaks against the best design: what the closer look at it came to, and its verification.
std::string refutation(const RunRecord& record) {
  std::string text;
  const EvaluationRecord* best = best_of(record);
  if (best != nullptr && !best->feasible)
    text += "Looked at with its wear history the best design does not keep every limit. ";
  if (record.best_design && !optimizer::converged(record.best_design->status))
    text += "Looked at with bars and its wear history the best design ends with \u201c" + record.best_design->status +
            "\u201d. ";
  for (const VerificationRecord& v : record.verifications) {
    if (!record.best || v.evaluation != static_cast<std::int64_t>(*record.best) || optimizer::converged(v.status))
      continue;
    text += optimizer::outcome_of(v.status) == optimizer::Outcome::disagrees
                ? "The verification does not confirm the best design: it " + v.status + ". "
                : "The best design could not be verified (" + v.status + "). ";
  }
  return text;
}

}  // namespace

std::string headline(const RunRecord& record) {
  const EvaluationRecord* base = baseline_of(record);
  const EvaluationRecord* best = best_of(record);
  if (record.evaluations.empty()) return "No candidate was evaluated.";
  if (!best) {
    if (const std::string why = why_none(record); !why.empty())
      return "No design was found: none of the candidates could be computed (" + why + ").";
    std::string text = "No feasible design was found: none of the candidates keeps every limit.";
    if (const std::vector<std::string> never = words_of(never_kept(record)); !never.empty())
      text += " No candidate keeps " + listed(never) + ".";
    if (record.least_broken && *record.least_broken < record.evaluations.size())
      text += fmt::format(" The nearest is candidate {}.", *record.least_broken + 1);
    return text;
  }
  const std::string doubt = refutation(record);
  if (record.front) return doubt + front_headline(record);
  if (record.best == record.baseline)
    return doubt + "No candidate was better than the start: it stays the best feasible design, with " +
           objective_value(record, *best) + ".";
  if (!base || !std::isfinite(base->objective))
    return doubt + fmt::format(
                       "The best design reaches {}. The start could not be evaluated ({}), so there is nothing to "
                       "compare it with.",
                       objective_value(record, *best), base ? base->status : "no start");
  std::string text = doubt;
  text +=
      record.problem.objective.size() == 1 ? single_term(record, *base, *best) : several_terms(record, *base, *best);
  if (!base->feasible && best->feasible) text += " The start itself breaks a limit, the best design keeps them all.";
  return text;
}

}  // namespace dovetail::report
