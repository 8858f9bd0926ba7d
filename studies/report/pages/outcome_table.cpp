// What became better and what worse.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "studies/report/pages/answers.hpp"
#include "studies/report/words/report_words.hpp"
#include "studies/report/words/table.hpp"
#include "studies/report/words/units.hpp"

namespace dovetail::report {

namespace {

using optimizer::Barred;

Html verdict(const char* style, const std::string& text) {
  return {"<span class=\"verdict " + std::string(style) + "\">" + escape(text) + "</span>"};
}

struct Compared {
  const EvaluationRecord* base;
  const EvaluationRecord* best;  ///< null: only the start there is
  [[nodiscard]] bool both() const { return base && best && base != best; }
};

/// Values of start and best design side by side, and how they differ.
void add_values(const Barred* from, const Barred& to, const Unit& unit, Row& row) {
  const auto shown = [&](const Barred& of) { return with_error(of.value, of.bar, unit); };
  if (from) {
    row.cells.emplace_back(std::isfinite(from->value) ? shown(*from) : "\u2013");
    row.cells.emplace_back(shown(to));
    row.cells.emplace_back(difference(from->value, to.value, unit));
  } else {
    row.cells.emplace_back(shown(to));
  }
}

Html objective_verdict(const optimizer::ObjectiveTerm& term, const Barred& from, const Barred& to) {
  const double change = (term.weight < 0 ? -1 : 1) * (to.value - from.value);
  if (!std::isfinite(change)) return verdict("soft", "nothing to compare with");
  if (std::abs(change) <= 1e-8 * std::max(std::abs(from.value), std::abs(to.value)))
    return verdict("soft", "as before");
  const double bars = from.bar + to.bar;
  if (std::isfinite(bars) && std::abs(change) <= bars)
    return verdict("soft", std::string(change < 0 ? "better" : "worse") + ", but within the bars");
  return change < 0 ? verdict("good", "better") : verdict("bad", "worse");
}

/// Of a limit, c of the start (NaN: not known) and of the best design, which is kept where it is not above 0.
Html limit_verdict(double before, double c, double bar) {
  const auto room = [](double of) { return significant(100 * std::abs(of), 2) + "\u00a0%"; };
  const std::string start = !std::isfinite(before) ? ""
                            : before > 0           ? " (start: broken)"
                                                   : " (start: " + room(before) + ")";
  if (!std::isfinite(bar))
    return verdict("soft", (c <= 0 ? "kept, " + room(c) + " room" : "broken by " + room(c)) +
                               ", but its response has no error bar" + start);
  if (std::abs(c) < bar) return verdict("soft", "undecided: nearer than its bar" + start);
  return c <= 0 ? verdict("good", "kept, " + room(c) + " room" + start)
                : verdict("bad", "broken by " + room(c) + start);
}

void add_objectives(const RunRecord& record, const Compared& designs, Table& table) {
  for (const optimizer::ObjectiveTerm& term : record.problem.objective) {
    const EvaluationRecord& last = designs.best ? *designs.best : *designs.base;
    const Barred to = shown_term(record.problem, term, last);
    const Barred from = designs.both() ? shown_term(record.problem, term, *designs.base) : Barred{};
    const double most = std::max(std::isfinite(from.value) ? std::abs(from.value) : 0, std::abs(to.value));
    Row row{.cells = {term_words(record.problem, term), term.weight < 0 ? "more" : "less"}, .style = "aim"};
    add_values(designs.both() ? &from : nullptr, to, response_unit(term.response, most), row);
    row.cells.push_back(designs.both() ? objective_verdict(term, from, to) : verdict("soft", ""));
    table.rows.push_back(std::move(row));
  }
}

void add_limits(const RunRecord& record, const Compared& designs, Table& table) {
  const EvaluationRecord& last = designs.best ? *designs.best : *designs.base;
  const auto bars_of = [&](const EvaluationRecord& e) {
    return judgement_bars(record.problem, e.responses, e.error_estimates).constraints;
  };
  const Numbers last_bars = bars_of(last), base_bars = designs.both() ? bars_of(*designs.base) : Numbers{};
  std::size_t j = 0;  // in the order of constraint_names
  const auto add = [&](const optimizer::ResponseConstraint& of, double limit, bool upper) {
    const double scale = (upper ? 1 : -1) * of.scale_at(limit);
    const auto at = [&](const EvaluationRecord& e, const Numbers& bars) {
      return j < e.constraints.size()
                 ? Barred{.value = limit + scale * e.constraints[j], .bar = std::abs(scale) * bars[j]}
                 : Barred{.value = std::nan(""), .bar = std::nan("")};
    };
    const Barred to = at(last, last_bars), from = designs.both() ? at(*designs.base, base_bars) : Barred{};
    const Unit unit = response_unit(of.response, std::max(std::abs(limit), std::abs(to.value)));
    Row row{.cells = {(of.absolute ? "size of the " : "") + words(of.response) + over_words(record.problem, of.over),
                      (upper ? "at most\u00a0" : "at least\u00a0") + plain(limit, unit)}};
    add_values(designs.both() ? &from : nullptr, to, unit, row);
    row.cells.push_back(std::isfinite(to.value)
                            ? limit_verdict(designs.both() ? designs.base->constraints[j] : std::nan(""),
                                            last.constraints[j], last_bars[j])
                            : verdict("soft", "not known"));
    table.rows.push_back(std::move(row));
    ++j;
  };
  for (const optimizer::ResponseConstraint& of : record.problem.constraints) {
    if (of.upper) add(of, *of.upper, true);
    if (of.lower) add(of, *of.lower, false);
  }
}

}  // namespace

std::string outcome_table(const RunRecord& record) {
  const EvaluationRecord* best = best_of(record);
  if (!best && record.least_broken && *record.least_broken < record.evaluations.size())
    best = &record.evaluations[*record.least_broken];
  Compared designs{.base = baseline_of(record), .best = best};
  if (designs.base && designs.base->constraints.size() != constraint_names(record.problem).size())
    designs.base = nullptr;
  if (!designs.base && !designs.best) return {};
  if (designs.best && designs.best->constraints.size() != constraint_names(record.problem).size()) return {};
  Table table{
      .columns = {{"", true}, {"wanted", true}}, .rows = {}, .style = designs.both() ? "outcome both" : "outcome"};
  const std::string after = best_of(record) ? best_word(record) : "nearest";
  if (designs.both())
    table.columns.insert(table.columns.end(), {{"before (start)"}, {"after (" + after + ")"}, {"change"}});
  else
    table.columns.push_back({designs.best ? after : "start"});
  table.columns.push_back({"", true});
  add_objectives(record, designs, table);
  add_limits(record, designs, table);
  return table_html(table);
}

}  // namespace dovetail::report
