// How sure a result is, how far it holds and what to do next, in sentences.
#include "studies/report/pages/answers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "optimizer/search/search_outcome.hpp"
#include "studies/report/record/influence.hpp"
#include "studies/report/words/report_words.hpp"
#include "studies/report/words/units.hpp"
#include "studies/report/words/unmet_words.hpp"

namespace dovetail::report {

namespace {

std::string percentage(double share) {
  return significant(100 * share, 2) + "\u00a0%";
}

std::string capital(std::string text) {
  if (!text.empty()) text.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(text.front())));
  return text;
}

/// "2 of the 5", "both", "all 5".
std::string part_of(std::size_t some, std::size_t all) {
  if (some == all) return all == 1 ? "the one" : all == 2 ? "both" : fmt::format("all {}", all);
  return fmt::format("{} of the {}", some == 0 ? "none" : std::to_string(some), all);
}

/// The limits of the best design that its error bars leave open.
std::vector<std::string> undecided(const RunRecord& record, const EvaluationRecord& best) {
  std::vector<std::string> found;
  const std::vector<std::string> names = constraint_names(record.problem);
  const Numbers bars = judgement_bars(record.problem, best.responses, best.error_estimates).constraints;
  for (std::size_t j = 0; j < std::min(names.size(), best.constraints.size()); ++j)
    if (std::abs(best.constraints[j]) < bars[j]) found.push_back(limit_words(names[j], record.problem));
  return found;
}

/// The limits that are broken, with how much.
std::vector<std::string> broken(const RunRecord& record, const Numbers& constraints) {
  std::vector<std::string> found;
  const std::vector<std::string> names = constraint_names(record.problem);
  for (std::size_t j = 0; j < std::min(names.size(), constraints.size()); ++j)
    if (constraints[j] > 0)
      found.push_back(
          fmt::format("{} by {}", limit_words(names[j], record.problem, false), percentage(constraints[j])));
  return found;
}

template <class Records>
auto of_best(const RunRecord& record, const Records& records) {
  std::vector<const typename Records::value_type*> found;
  for (const auto& one : records)
    if (record.best && one.evaluation == static_cast<std::int64_t>(*record.best)) found.push_back(&one);
  return found;
}

/// How the best design keeps its limits on a finer mesh.
std::string kept_there(const RunRecord& record, const EvaluationRecord& best, const FinerRecord& look) {
  if (!optimizer::converged(look.status)) return "could not be computed (" + look.status + ")";
  if (const auto limits = broken(record, look.constraints); !limits.empty()) return "breaks " + listed(limits);
  const auto nearest = std::ranges::max_element(look.constraints);
  const auto at = static_cast<std::size_t>(nearest - look.constraints.begin());
  const std::vector<std::string> names = constraint_names(record.problem);
  if (at >= names.size()) return "keeps every limit";
  const Numbers bars = judgement_bars(record.problem, best.responses, best.error_estimates).constraints;
  return fmt::format("keeps every limit; nearest is {} with {} room{}", limit_words(names[at], record.problem),
                     percentage(-*nearest), -*nearest < bars[at] ? ", less than its error bar" : "");
}

std::string plain_bar(double bar, const Unit& unit) {
  return significant(bar / unit.si, 2) + (unit.symbol.empty() ? "" : "\u00a0" + unit.symbol);
}

std::string bars_sentence(const RunRecord& record, const EvaluationRecord& best) {
  std::vector<std::string> parts;
  for (const optimizer::ObjectiveTerm& term : record.problem.objective) {
    const optimizer::Barred value = shown_term(record.problem, term, best);
    if (!std::isfinite(value.bar)) continue;
    parts.push_back(term_words(record.problem, term) + " \u00b1" +
                    (value.value != 0 ? percentage(value.bar / std::abs(value.value))
                                      : plain_bar(value.bar, response_unit(term.response, value.bar))));
  }
  if (parts.empty()) return "The objective has no error bar.";
  return fmt::format("Error bar{}: {}.", parts.size() == 1 ? "" : "s", listed(parts));
}

}  // namespace

std::vector<std::string> how_sure(const RunRecord& record) {
  const EvaluationRecord* best = best_of(record);
  if (!best) return {};
  std::vector<std::string> all{bars_sentence(record, *best)};
  if (const auto open = without_bar(record); !open.empty())
    all.push_back(
        fmt::format("No error is known of {}: the mesh does not settle it, as at sharp ends of the flanks, where the "
                    "pressure grows "
                    "without limit the finer the mesh.",
                    listed(open)));
  if (const auto open = undecided(record, *best); !open.empty())
    all.push_back(
        fmt::format("Undecided: {} {} nearer than the error bars.", listed(open), open.size() == 1 ? "is" : "are"));
  const auto verified = of_best(record, record.verifications);
  for (const VerificationRecord* v : verified)
    all.push_back(fmt::format("Wear by the full history, wear found directly and at finer settings{}: {}.",
                              v->load_case.empty() ? "" : " (" + v->load_case + ")", v->agreement()));
  if (verified.empty()) all.push_back("The best design was not held against a wear history.");
  for (const FinerRecord* finer : of_best(record, record.finer))
    all.push_back(fmt::format("{} it {}.", capital(mesh_words(*finer)), kept_there(record, *best, *finer)));
  return all;
}

std::vector<std::string> how_far(const RunRecord& record) {
  const auto there = of_best(record, record.departures);
  if (there.empty()) return {};
  std::vector<std::string> breaking;
  std::size_t kept = 0;
  for (const DepartureRecord* at : there) {
    const std::vector<std::string> limits = broken(record, at->constraints);
    if (!optimizer::converged(at->status))
      breaking.push_back(fmt::format("with {} it cannot be computed ({})", departure_words(*at), at->status));
    else if (!limits.empty())
      breaking.push_back(fmt::format("with {} it breaks {}", departure_words(*at), listed(limits)));
    else
      ++kept;
  }
  std::vector<std::string> all{fmt::format(
      "It keeps its limits in {} of {} cases in which friction, force, speed or mismatch are not as the study says.",
      kept, there.size())};
  for (const std::string& each : breaking) all.push_back(capital(each) + ".");
  if (record.front) return all;
  double least = std::nan(""), most = least;
  for (const DepartureRecord* at : there) {
    least = std::fmin(least, at->objective);
    most = std::fmax(most, at->objective);
  }
  if (const ObjectiveScale scale = objective_scale(record); std::isfinite(least)) {
    const auto shown = [&](double objective) { return significant(scale.factor * objective, 3); };
    const std::string unit = scale.unit.empty() ? "" : "\u00a0" + scale.unit;
    const std::string range = shown(least) == shown(most) ? shown(least) : shown(least) + " to " + shown(most);
    all.push_back(fmt::format("There its {} is {}{}; as the study says it is {}{}.", scale.label, range, unit,
                              shown(best_of(record)->objective), unit));
  }
  return all;
}

namespace {

/// A search goes on where the box ended.
void add_bounds(const RunRecord& record, const EvaluationRecord& best, std::vector<std::string>& all) {
  const std::vector<optimizer::DesignVariable>& variables = record.problem.space.variables();
  std::vector<std::string> at;
  for (std::size_t i = 0; i < std::min(variables.size(), best.x.size()); ++i) {
    const optimizer::DesignVariable& v = variables[i];
    const std::string bound = at_bound(v, best.x[i]), unit = key_unit(v.key);
    if (bound.empty()) continue;
    at.push_back(fmt::format("{} ({} {}{})", key_words(v.key), bound == "lower" ? "below" : "above",
                             plain(bound == "lower" ? v.lower : v.upper), unit.empty() ? "" : "\u00a0" + unit));
  }
  if (!at.empty())
    all.push_back(
        fmt::format("Widen: {} variables stand{} at {}. If the part allows it, let the search look further for the {}.",
                    part_of(at.size(), variables.size()), at.size() == 1 ? "s" : "",
                    at.size() == 1 ? "a bound" : "bounds", listed(at)));
}

/// Variables that do next to nothing to objective and limits, where the candidates tell what does.
void add_idle(const RunRecord& record, std::vector<std::string>& all) {
  constexpr double kNothing = 0.01, kTold = 0.5;
  std::vector<Numbers> counting(1 + constraint_names(record.problem).size());
  for (const EvaluationRecord& e : record.evaluations) {
    counting[0].push_back(e.objective);
    for (std::size_t j = 1; j < counting.size(); ++j)
      counting[j].push_back(j <= e.constraints.size() ? e.constraints[j - 1] : std::nan(""));
  }
  std::vector<char> acts(record.problem.space.size(), 0);
  for (const Numbers& values : counting) {
    const Influence of = influence(record, values);
    // What never varies says nothing; what varies for unknown reasons may vary by any of them.
    const bool varies = std::ranges::adjacent_find(values, std::ranges::not_equal_to()) != values.end();
    if (varies && (of.variables.empty() || of.explained < kTold)) return;
    for (std::size_t v = 0; v < of.variables.size(); ++v)
      if (of.variables[v].share >= kNothing) acts[v] = 1;
  }
  std::vector<std::string> idle;
  for (std::size_t v = 0; v < acts.size(); ++v)
    if (acts[v] == 0) idle.push_back(key_words(record.problem.space.variables()[v].key));
  if (!idle.empty() && idle.size() < acts.size())
    all.push_back(
        fmt::format("Fix: the {} {} hardly anything to objective and limits among the candidates seen; without {} a "
                    "search is shorter.",
                    listed(idle), idle.size() == 1 ? "does" : "do", idle.size() == 1 ? "it" : "them"));
}

/// Where the objective does not tell the designs apart, or not the best one from the start.
void add_indifferent(const RunRecord& record, const EvaluationRecord& best, std::vector<std::string>& all) {
  const EvaluationRecord* start = baseline_of(record);
  std::vector<double> objectives;
  for (const EvaluationRecord& e : record.evaluations)
    if (std::isfinite(e.objective)) objectives.push_back(e.objective);
  if (objectives.size() > 1 && std::ranges::adjacent_find(objectives, std::ranges::not_equal_to()) == objectives.end())
    all.push_back(
        "Ask for something else: the objective is the same for all candidates, so it tells none of them apart. Another "
        "response, a larger load or other limits would.");
  else if (start && start != &best && !record.front && record.problem.objective.size() == 1) {
    const optimizer::ObjectiveTerm& term = record.problem.objective.front();
    const optimizer::Barred from = shown_term(record.problem, term, *start),
                            to = shown_term(record.problem, term, best);
    if (std::abs(to.value - from.value) <= from.bar + to.bar)
      all.push_back(
          "Compute more accurately ([solver] accuracy): start and best design are not told apart by their error bars.");
  }
}

}  // namespace

std::vector<std::string> what_next(const RunRecord& record) {
  std::vector<std::string> all;
  const EvaluationRecord* best = best_of(record);
  if (record.evaluations.empty()) return all;
  const std::optional<Status> status = named<Status>(record.status);
  if (!best) {
    std::vector<std::string> never;
    for (const Unkept& unkept : never_kept(record))
      if (!unkept.limit.empty()) never.push_back(unkept.limit);
    if (!never.empty()) all.push_back("Loosen " + listed(never) + ", or let other variables help to keep it.");
    if (const std::string why = why_none(record); !why.empty())
      all.push_back(
          "Find out why nothing can be computed: " + why +
          ". What to try is said of every status on the page of statuses; dovetail evaluate looks at one design.");
    else if (record.least_broken)
      all.push_back(
          fmt::format("Start from candidate {}, which is nearest to keeping every limit.", *record.least_broken + 1));
  } else {
    add_indifferent(record, *best, all);
    const bool doubted = std::ranges::any_of(of_best(record, record.verifications), [](const VerificationRecord* v) {
      return !optimizer::converged(v->status);
    });
    if (doubted) all.push_back("Look into the verification first: its table says what does not agree.");
    add_bounds(record, *best, all);
    std::vector<std::string> held;
    for (const Holder& by : holding(record))
      if (by.what.find(" bound of ") == std::string::npos) held.push_back(by.what);
    if (!held.empty())
      all.push_back(fmt::format("Loosen {} if more is wanted: {} the best design.", listed(held),
                                held.size() == 1 ? "it holds" : "they hold"));
    if (const auto open = undecided(record, *best); !open.empty())
      all.push_back(
          "Tighten what the study asks for or compute more accurately ([optimizer] verify_accuracy, [solver] "
          "accuracy): " +
          listed(open) + " cannot be decided.");
    if (record.problem.cases.empty() && !of_best(record, record.departures).empty() && how_far(record).size() > 1)
      all.push_back(
          "Make it hold for more than one load: [[uncertain]] and [[case]] let friction, force and speed count in the "
          "search.");
    if (of_best(record, record.verifications).empty())
      all.push_back("Verify: [optimizer] verify = 1 wears the best design cycle by cycle.");
    add_idle(record, all);
  }
  if (status == Status::iteration_limit && record.message == optimizer::kBudgetUsedUp)
    all.push_back(
        "Go on: the search ended because its evaluations were used up; with a larger max_evaluations, dovetail run "
        "--resume goes on where it stopped.");
  if (status == Status::interrupted)
    all.push_back("Go on: dovetail run --resume goes on where the run was interrupted.");
  return all;
}

}  // namespace dovetail::report
