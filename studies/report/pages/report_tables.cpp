#include "studies/report/pages/report_tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "optimizer/responses/response_table.hpp"
#include "studies/report/pages/html.hpp"
#include "studies/report/pages/report_words.hpp"

namespace dovetail::report {

namespace {

std::string header(const std::vector<std::string>& columns) {
  std::string text = "<thead><tr>";
  for (const std::string& column : columns) {
    const bool textual = column == "key" || column == "found by" || column == "status" || column == "limit";
    text += std::string("<th scope=\"col\"") + (textual ? " class=\"text\">" : ">") + escape(column) + "</th>";
  }
  return text + "</tr></thead>";
}

/// Responses the two evaluations have: those of the table in its order, then others.
std::vector<std::string> names_of(const EvaluationRecord* first, const EvaluationRecord* second) {
  const auto known = [&](const std::string& name) {
    return (first && first->responses.count(name) > 0) || (second && second->responses.count(name) > 0);
  };
  std::vector<std::string> names;
  for (const optimizer::Response& response : optimizer::responses())
    if (known(std::string(response.name))) names.emplace_back(response.name);
  for (const EvaluationRecord* evaluation : {first, second}) {
    if (!evaluation) continue;
    for (const auto& [name, value] : evaluation->responses)
      if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  }
  return names;
}

std::string shown_response(const EvaluationRecord* evaluation, const std::string& name, const Unit& unit) {
  if (!evaluation) return "\u2013";
  const double value = response(*evaluation, name);
  if (std::isnan(value)) return "\u2013";
  const bool open = !evaluation->error_estimates.empty() && !evaluation->error_estimates.contains(name);
  return with_error(value, error_bar(*evaluation, name), unit) +
         (open ? " <span class=\"soft\">without a bar</span>" : "");
}

/// Change in per cent, of quantities that may change sign in their own unit; with "within the error" where it is.
std::string change(const EvaluationRecord& from, const EvaluationRecord& to, const std::string& name,
                   const Unit& unit) {
  const double a = response(from, name), b = response(to, name);
  if (!std::isfinite(a) || !std::isfinite(b)) return "\u2013";
  // What only rounding of the design variables makes.
  if (std::abs(b - a) <= 1e-8 * std::max(std::abs(a), std::abs(b))) return "none";
  const double bars = error_bar(from, name) + error_bar(to, name);
  const bool small = bars > 0 && std::abs(b - a) <= bars;
  std::string text;
  if (a > 0 && b > 0) {
    const double percent = 100 * (b / a - 1);
    text = (percent > 0 ? "+" : "") + significant(percent, std::abs(percent) >= 10 ? 3 : 2) + "\u00a0%";
  } else {
    text = (b > a ? "+" : "") + significant((b - a) / unit.si, 3) + "\u00a0" + unit.symbol;
  }
  return small ? text + " <span class=\"soft\">within error</span>" : text;
}

/// A value of a variable; what is nothing beside its range is 0.
std::string variable_value(const optimizer::DesignVariable& variable, double value) {
  return plain(std::abs(value) < 1e-9 * (variable.upper - variable.lower) ? 0 : value, 5);
}

std::string help_of(const std::string& name) {
  const optimizer::Response* known = optimizer::find_response(name);
  return known ? std::string(known->help) : name;
}

bool is_objective(const RunRecord& record, const std::string& name) {
  return std::any_of(record.problem.objective.begin(), record.problem.objective.end(),
                     [&](const optimizer::ObjectiveTerm& term) { return term.response == name; });
}

}  // namespace

std::string key_figures(const RunRecord& record) {
  const EvaluationRecord* base = baseline_of(record);
  const EvaluationRecord* best = best_of(record);
  const bool both = base && best && base != best;
  const std::vector<std::string> names = names_of(base, best);
  if (names.empty()) return "<p>Neither the start nor any other design could be evaluated in full.</p>\n";
  std::string text = std::string("<div class=\"scroll\"><table class=\"figures") + (both ? " pair" : "") + "\">";
  text += both ? header({"", "before (start)", "after (best)", "change"})
               : header({"", best ? "best (the start)" : "start"});
  text += "<tbody>\n";
  for (const std::string& name : names) {
    const double largest =
        std::max(base ? std::abs(response(*base, name)) : 0, best ? std::abs(response(*best, name)) : 0);
    const Unit unit = response_unit(name, largest);
    text += fmt::format("<tr{}><th scope=\"row\" title=\"{}\">{}</th>",
                        is_objective(record, name) ? " class=\"aim\"" : "", escape(help_of(name)), escape(words(name)));
    if (both)
      text += fmt::format("<td>{}</td><td>{}</td><td>{}</td>", shown_response(base, name, unit),
                          shown_response(best, name, unit), change(*base, *best, name, unit));
    else
      text += fmt::format("<td>{}</td>", shown_response(best ? best : base, name, unit));
    text += "</tr>\n";
  }
  return text + "</tbody></table></div>\n";
}

std::string variable_table(const RunRecord& record) {
  const EvaluationRecord* best = best_of(record);
  std::string text = "<div class=\"scroll\"><table>" +
                     header({"", "unit", "lower", "upper", "start", "best", "", "key"}) + "<tbody>\n";
  const std::vector<optimizer::DesignVariable>& variables = record.problem.space.variables();
  for (std::size_t i = 0; i < variables.size(); ++i) {
    const optimizer::DesignVariable& v = variables[i];
    const bool known = best && i < best->x.size();
    const std::string bound = known ? at_bound(v, best->x[i]) : "";
    text += fmt::format("<tr><th scope=\"row\">{}</th><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td><b>{}</b></td>",
                        escape(key_words(v.key)), key_unit(v.key), plain(v.lower), plain(v.upper), plain(v.start),
                        known ? variable_value(v, best->x[i]) : "\u2013");
    text += fmt::format("<td>{}</td><td class=\"text\"><code>{}</code></td></tr>\n",
                        bound.empty() ? "" : "<span class=\"flag\">at " + bound + " bound</span>", escape(v.key));
  }
  return text + "</tbody></table></div>\n";
}

std::string problem_list(const RunRecord& record) {
  std::string text = "<ul>\n";
  for (const optimizer::ObjectiveTerm& term : record.problem.objective) {
    text += fmt::format("<li>{} the {}{}", term.weight < 0 ? "Maximise" : "Minimise", escape(words(term.response)),
                        term.absolute ? " (magnitude)" : "");
    if (record.problem.objective.size() > 1) {
      const Unit unit = response_unit(term.response, term.scale);
      text += fmt::format(", weight {}, scale {}", plain(std::abs(term.weight)), plain(term.scale, unit));
    }
    text += "</li>\n";
  }
  for (const optimizer::ResponseConstraint& c : record.problem.constraints) {
    const Unit unit = response_unit(c.response, std::max(std::abs(c.lower.value_or(0)), std::abs(c.upper.value_or(0))));
    text += "<li>Keep the " + escape(words(c.response)) + (c.absolute ? " (magnitude)" : "");
    if (c.lower) text += " at least " + plain(*c.lower, unit);
    if (c.upper) text += std::string(c.lower ? " and" : "") + " at most " + plain(*c.upper, unit);
    text += "</li>\n";
  }
  return text + "</ul>\n";
}

std::string limit_table(const RunRecord& record) {
  const EvaluationRecord* best = best_of(record);
  std::vector<const FinerRecord*> finer;
  for (const FinerRecord& check : record.finer)
    if (record.best && check.evaluation == static_cast<std::int64_t>(*record.best)) finer.push_back(&check);
  const std::vector<std::string> names = constraint_names(record.problem);
  if (best == nullptr || finer.empty() || best->constraints.size() != names.size()) return {};
  std::vector<std::string> columns{"limit", "room left (%)"};
  for (const FinerRecord* check : finer) columns.push_back(fmt::format("on {} edges (%)", check->flank_elements));
  const optimizer::JudgementBars bars = judgement_bars(record.problem, best->error_estimates);
  std::string text =
      "<p>How far the best design stays from its limits, in per cent of each, on the mesh of the search "
      "and on finer ones. Where the room is within the error bar on the mesh of the search the limit is "
      "undecided.</p>\n<div class=\"scroll\"><table>" +
      header(columns) + "<tbody>\n";
  for (std::size_t j = 0; j < names.size(); ++j) {
    const std::size_t colon = names[j].rfind(':');
    const std::string limited = names[j].substr(0, colon), side = names[j].substr(colon + 1);
    const double bar = bars.constraints[j];
    const auto undecided = [bar](double constraint) { return std::abs(constraint) < bar ? " undecided" : ""; };
    text += fmt::format("<tr><th scope=\"row\" class=\"text\">{}, {}</th><td>{}{}</td>", escape(words(limited)), side,
                        with_error(-best->constraints[j], bar, {.symbol = "", .si = 0.01}),
                        undecided(best->constraints[j]));
    for (const FinerRecord* check : finer)
      text += fmt::format("<td>{}</td>",
                          j < check->constraints.size() && std::isfinite(check->constraints[j])
                              ? significant(-100 * check->constraints[j], 3) + undecided(check->constraints[j])
                              : escape(check->status));
    text += "</tr>\n";
  }
  return text + "</tbody></table></div>\n";
}

std::string evaluation_table(const RunRecord& record) {
  const std::vector<optimizer::DesignVariable>& variables = record.problem.space.variables();
  const ObjectiveScale objective = objective_scale(record);
  std::vector<std::string> columns{"#", "found by", "status",
                                   objective.label + (objective.unit.empty() ? "" : " (" + objective.unit + ")")};
  for (const std::string& name : constraint_names(record.problem)) {
    const std::size_t colon = name.rfind(':');
    columns.push_back(words(name.substr(0, colon)) + (colon == std::string::npos ? "" : ", " + name.substr(colon + 1)));
  }
  for (const optimizer::DesignVariable& v : variables)
    columns.push_back(key_words(v.key) + (key_unit(v.key).empty() ? "" : " (" + key_unit(v.key) + ")"));
  std::string text =
      fmt::format("<details><summary>All {} candidates</summary><div class=\"scroll\"><table>{}<tbody>\n",
                  record.evaluations.size(), header(columns));
  for (std::size_t i = 0; i < record.evaluations.size(); ++i) {
    const EvaluationRecord& e = record.evaluations[i];
    const std::string status = e.status != "converged" ? e.status : e.feasible ? "feasible" : "breaks a limit";
    std::string remark;
    for (const std::string& message : e.messages) remark += (remark.empty() ? "" : " ") + message;
    text += fmt::format(
        "<tr class=\"{}\"><td>{}</td><td class=\"text\">{}</td><td class=\"text\" title=\"{}\">{}</td><td>{}</td>",
        record.best == i ? "aim"
        : e.feasible     ? ""
                         : "soft",
        i + 1, escape(e.phase), escape(remark), escape(status), significant(objective.factor * e.objective, 4));
    for (const double c : e.constraints) text += "<td>" + significant(c, 3) + "</td>";
    for (std::size_t k = 0; k < std::min(variables.size(), e.x.size()); ++k)
      text += "<td>" + variable_value(variables[k], e.x[k]) + "</td>";
    text += "</tr>\n";
  }
  return text + "</tbody></table></div></details>\n";
}

std::string provenance_section(const RunRecord& record) {
  const Provenance& p = record.provenance;
  std::string libraries;
  for (const auto& [name, version] : p.libraries) libraries += (libraries.empty() ? "" : ", ") + name + " " + version;
  std::string text = "<dl>\n";
  const auto row = [&](const char* name, const std::string& value) {
    if (!value.empty()) text += fmt::format("<dt>{}</dt><dd>{}</dd>\n", name, escape(value));
  };
  row("Program", p.program_version.empty() ? "" : "dovetail " + p.program_version);
  row("Date", p.date_utc);
  row("Time taken", !(record.seconds > 0)  ? ""
                    : record.seconds < 120 ? significant(record.seconds, 3) + " s"
                                           : significant(record.seconds / 60, 3) + " min");
  row("Compiler", p.compiler);
  row("Libraries", libraries);
  row("Study", p.study_file);
  text += "</dl>\n";
  if (!p.options.empty()) {
    text += "<details><summary>Options of the optimiser</summary><div class=\"scroll\"><table><tbody>\n";
    for (const auto& [key, value] : p.options)
      text += fmt::format("<tr><th scope=\"row\"><code>{}</code></th><td class=\"text\">{}</td></tr>\n", escape(key),
                          escape(value));
    text += "</tbody></table></div></details>\n";
  }
  if (!p.study_text.empty())
    text += "<details><summary>The study file</summary><pre>" + escape(p.study_text) + "</pre></details>\n";
  return text;
}

}  // namespace dovetail::report
