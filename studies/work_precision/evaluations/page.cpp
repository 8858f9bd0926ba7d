#include "studies/work_precision/evaluations/page.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "optimizer/responses/response_table.hpp"
#include "studies/report/words/units.hpp"
#include "studies/work_precision/evaluations/drawings.hpp"
#include "studies/work_precision/evaluations/figures.hpp"
#include "studies/work_precision/evaluations/verdicts.hpp"

namespace dovetail::work_precision {
namespace {

using report::escape;
using report::Row;
using report::Table;

std::string percent(double fraction) {
  return fmt::format("{:g} %", 100 * fraction);
}

std::string words_of(const WholeDiagram& diagram, const WholePoint& point) {
  return setting_words(point.run.setting, diagram.edges_of_file);
}

/// What a row of the table of times begins with: whose seconds, at which settings.
Row row_of(const WholeDiagram& diagram, const std::string& what, const WholePoint& point) {
  const report::Html head{escape(what) + "<br><span class=\"soft\">" + escape(words_of(diagram, point)) + "</span>"};
  return {
      {head, cell(point.run.seconds, "{:.3g}"), point.run.converged() ? error_words(point.worst) : point.run.status}};
}

Table times(const WholeDiagram& diagram) {
  Table table = table_of({"", "seconds", "true error", "factor: asked", "steady", "own error", "choice (s)", "rounds"});
  table.style = "times";
  const auto add = [&](const std::string& what, const WholePoint& point, const std::vector<std::string>& after) {
    Row row = row_of(diagram, what, point);
    for (const std::string& text : after) row.cells.emplace_back(text);
    table.rows.push_back(std::move(row));
  };
  for (const AutomaticChoice& choice : diagram.automatic) {
    const Comparison comparison = compare(diagram, choice);
    const std::string asked = percent(choice.asked);
    if (comparison.for_asked)
      add(asked + ": cheapest known", *comparison.for_asked, {"1", "", "", "", ""});
    else
      table.rows.push_back({{asked + ": cheapest known", "\u2013", "none", "", "", "", "", ""}});
    if (comparison.steady) add(asked + ": with finer ones", *comparison.steady, {"", "1", "", "", ""});
    add(asked + ": automatic choice", choice.point,
        {cell(comparison.factor_asked, "{:.2f}"), cell(comparison.factor_steady, "{:.2f}"),
         cell(comparison.factor_error, "{:.2f}"), cell(choice.seconds, "{:.3g}"),
         std::to_string(choice.rounds.size())});
  }
  for (const WholeLine& line : diagram.lines)
    if (line.key == WholeSweep::paper)
      for (const WholePoint& point : line.points) add(point.label, point, {"", "", "", "", ""});
  return table;
}

/// "RESPONSE, RESPONSE", in words.
std::string named(const std::vector<std::string>& responses) {
  std::vector<std::string> texts;
  for (const std::string& name : responses) texts.push_back(report::words(name));
  return fmt::format("{}", fmt::join(texts, ", "));
}

std::string variables_words(const WholeDiagram& diagram) {
  std::vector<std::string> texts;
  for (const auto& [key, value] : diagram.variables)
    texts.push_back(fmt::format("{} {:.3g}\u00a0{}", report::key_words(key), value, report::key_unit(key)));
  return texts.empty() ? "" : fmt::format(" It has {}.", fmt::join(texts, ", "));
}

Table numbers(const WholeDiagram& diagram) {
  Table table = table_of({"setting", "seconds", "once per search (s)", "contact nodes", "worst error"});
  std::vector<std::string> responses;
  for (const optimizer::Response& response : optimizer::responses())
    if (errs(diagram, std::string(response.name))) {
      responses.emplace_back(response.name);
      table.columns.push_back({"of " + report::words(response.name)});
    }
  table.columns.push_back({"status", true});
  const auto add = [&](const std::string& line, const WholePoint& point) {
    Row row{{line + ": " + point.label, cell(point.run.seconds, "{:.3g}"), cell(point.run.setup_seconds, "{:.2g}"),
             std::to_string(point.run.contact_nodes), cell(point.worst, "{:.2e}")}};
    for (const std::string& name : responses) row.cells.emplace_back(cell(error_of(point, name), "{:.2e}"));
    row.cells.emplace_back(point.run.status);
    table.rows.push_back(std::move(row));
  };
  add("reference", diagram.reference.finest);
  add("reference", diagram.reference.check);
  for (const WholeLine& line : diagram.lines)
    for (const WholePoint& point : line.points) add(std::string(to_string(line.key)), point);
  for (const AutomaticChoice& choice : diagram.automatic) add("automatic", choice.point);
  return table;
}

std::string section(const WholeDiagram& diagram) {
  const auto paragraph = [](const std::string& text, const char* style = "") {
    return "<p" + std::string(style) + ">" + escape(text) + "</p>\n";
  };
  std::string html = "<section id=\"" + diagram.key + "\"><h2>" + escape(diagram.title) + "</h2>\n";
  html += paragraph(diagram.description + variables_words(diagram) +
                    (diagram.judged_by_study ? " Responses that objective and limits name: "
                                             : " The study names no response, so all that have a limit count: ") +
                    named(diagram.judged) + ".");
  html += paragraph(reference_verdict(diagram));
  html += "<h3 class=\"above\">How long for which accuracy</h3>\n" + report::table_html(times(diagram));
  for (const AutomaticChoice& choice : diagram.automatic)
    html += paragraph(choice_verdict(diagram, choice), " class=\"verdict\"");
  html += paragraph(paper_verdict(diagram), " class=\"verdict\"");
  const report::Plot worst = response_plot(diagram, kWorst);
  html += "<h3 class=\"above\">Every response</h3>\n";
  std::string drawings = drawing(worst);
  std::vector<std::string> exact;
  for (const optimizer::Response& response : optimizer::responses()) {
    const std::string name(response.name);
    if (!diagram.reference.check.error.contains(name)) continue;
    if (errs(diagram, name))
      drawings += drawing(response_plot(diagram, name));
    else
      exact.push_back(name);
  }
  if (!exact.empty()) html += paragraph("Without error at all settings: " + named(exact) + ".");
  return html + side_by_side(drawings, numbers(diagram)) + "</section>\n";
}

}  // namespace

std::string evaluations_html(const std::vector<WholeDiagram>& diagrams) {
  std::string html;
  for (const WholeDiagram& diagram : diagrams) html += section(diagram);
  return html;
}

}  // namespace dovetail::work_precision
