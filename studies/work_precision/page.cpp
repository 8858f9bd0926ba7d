#include <fmt/format.h>

#include <array>
#include <cmath>

#include "studies/ready_study/program.hpp"
#include "studies/report/pages/page.hpp"
#include "studies/report/plots/plot.hpp"
#include "studies/report/words/table.hpp"
#include "studies/work_precision/evaluations/drawings.hpp"
#include "studies/work_precision/evaluations/page.hpp"
#include "studies/work_precision/evaluations/plan.hpp"
#include "studies/work_precision/evaluations/tables.hpp"
#include "studies/work_precision/figures.hpp"
#include "studies/work_precision/results.hpp"
#include "studies/work_precision/texts.hpp"

namespace dovetail::work_precision {
namespace {

using report::escape;
using report::Table;

Table numbers(const Sweep& sweep) {
  Table table = table_of({"setting", "resonance (s)", "model (s)", "Jacobians", "frequency (rad/s)", "energy (J)",
                          "amplitude", "error of frequency", "of energy", "of amplitude", "status"});
  for (const Line& line : sweep.lines)
    for (const Point& point : line.points) {
      const Run& run = point.run;
      report::Row row{
          {line.name + (line.name.empty() ? "" : ", ") + point.label + (point.is_default ? " (default)" : ""),
           cell(run.seconds, "{:.3g}"), run.model_seconds > 0 ? cell(run.model_seconds, "{:.3g}") : "\u2013",
           std::to_string(run.jacobians)}};
      for (const double value : run.value) row.cells.emplace_back(run.converged() ? cell(value, "{:.9g}") : "\u2013");
      for (const double error : point.error) row.cells.emplace_back(cell(error, "{:.2e}"));
      row.cells.emplace_back(run.status);
      table.rows.push_back(std::move(row));
    }
  return table;
}

std::string settings_words(const Run& run, bool meshed) {
  const Setting& s = run.setting;
  std::string text = fmt::format("H = {}, N = {}", s.harmonics, s.samples);
  if (s.penalty != 1) text += fmt::format(", {:g} eps", s.penalty);
  if (meshed) text += fmt::format(", {} modes, {} edges", s.modes, s.flank_elements);
  return text;
}

void add_reference(const std::string& name, const Reference& reference, bool meshed, Table& table) {
  const auto add = [&](const std::string& what, const std::array<double, 3>& values, const char* format,
                       const std::string& seconds) {
    report::Row row{{what}};
    for (const double value : values) row.cells.emplace_back(cell(value, format));
    row.cells.emplace_back(seconds);
    table.rows.push_back(std::move(row));
  };
  for (const auto& [what, run] : {std::pair{name, &reference.run}, {"Check", &reference.check}})
    add(what + ": " + settings_words(*run, meshed), run->value, "{:.9g}",
        run->converged() ? cell(run->seconds + run->model_seconds, "{:.3g}") : run->status);
  add("They agree to", reference.agreement, "{:.1e}", "");
}

std::string reference_table(const Diagram& diagram) {
  const bool meshed = diagram.mesh_reference.has_value();
  Table table = table_of({"reference", "resonance (rad/s)", "energy (J)", "amplitude", "seconds"});
  add_reference("Reference", diagram.reference, meshed, table);
  if (meshed) add_reference("For the mesh", *diagram.mesh_reference, meshed, table);
  return table_html(table);
}

std::string sweep_section(const Diagram& diagram, const Sweep& sweep) {
  std::string text = "<h3 class=\"sweep\">" + escape(sweep.title) + "</h3>\n<p class=\"verdict\">" +
                     escape(verdict(sweep, kGoal)) + "</p>\n";
  std::string drawings;
  for (std::size_t q = 0; q < kQuantities.size(); ++q) drawings += drawing(error_plot(diagram, sweep, q));
  return text + side_by_side(drawings, numbers(sweep));
}

std::string diagram_section(const Diagram& diagram) {
  const Run& run = diagram.reference.run;
  std::string text = "<section id=\"" + diagram.key + "\"><h2>" + escape(diagram.title) + "</h2>\n<p>" +
                     escape(diagram.description) +
                     fmt::format(" At its resonance {} of {} nodes stay stuck, {} slip and {} lift off for a while.",
                                 run.stuck, run.contact_nodes, run.slipping, run.separating) +
                     "</p>\n" + reference_table(diagram);
  for (const Sweep& sweep : diagram.sweeps) text += sweep_section(diagram, sweep);
  return text + "</section>\n";
}

std::string exponents(const std::vector<Growth>& growths) {
  std::string text;
  for (const Growth& growth : growths)
    text += fmt::format(
        " Between the last two points over {} the step grows with the power {:.1f}, the residual with its "
        "derivative with {:.1f} and the full LU with {:.1f}.",
        growth.title, exponent(growth, &StepTimes::step), exponent(growth, &StepTimes::derivative),
        exponent(growth, &StepTimes::lu));
  return text;
}

std::string growth_figures(const std::vector<Growth>& growths) {
  std::string drawings;
  Table table = table_of({"over", "nodes", "H", "N", "unknowns", "factorised", "residual (ms)", "with D (ms)",
                          "dense J (ms)", "full LU (ms)", "condensed J and LU (ms)", "solve (ms)", "Newton step (ms)"});
  for (const Growth& growth : growths) {
    drawings += drawing(growth_plot(growth));
    for (const StepTimes& t : growth.times) {
      report::Row row{{growth.title, std::to_string(t.nodes), std::to_string(t.harmonics), std::to_string(t.samples),
                       std::to_string(t.unknowns), std::to_string(t.factorised)}};
      for (const double part : {t.residual, t.derivative, t.jacobian, t.lu, t.linearise, t.solve, t.step})
        row.cells.emplace_back(t.status == Status::converged ? fmt::format("{:.3g}", 1e3 * part) : "failed");
      table.rows.push_back(std::move(row));
    }
  }
  return side_by_side(drawings, table);
}

}  // namespace

std::string page_html(const Results& results) {
  std::string diagrams;
  for (const Diagram& diagram : results.diagrams) diagrams += diagram_section(diagram);
  const Circumstances& made = results.made;
  return report::page(
      "Speed against error \u2013 dovetail", texts::page_css,
      report::fill(texts::page_html,
                   {{"quick", made.quick ? "yes" : ""},
                    {"diagrams", diagrams},
                    {"evaluations", evaluations_html(results.evaluations)},
                    {"exponents", exponents(results.growth)},
                    {"steps", std::to_string(section_plan(made.quick, true).wear_steps)},
                    {"growth", results.growth.empty() ? "" : growth_figures(results.growth)},
                    {"provenance", report::definition_list({{"Commit", made.commit},
                                                            {"Machine", made.machine},
                                                            {"System", made.system},
                                                            {"Linear algebra", made.blas},
                                                            {"Compiler", made.compiler},
                                                            {"Date", made.date_utc},
                                                            {"Time taken", fmt::format("{:.0f} s", made.seconds)}})}}));
}

void write(const std::filesystem::path& folder, const Results& results) {
  ready_study::write(folder, {{"table.csv", table_csv(results)},
                              {"growth.csv", growth_csv(results)},
                              {"evaluations.csv", evaluations_csv(results.evaluations)},
                              {"table.json", table_json(results)},
                              {"index.html", page_html(results)}});
}

}  // namespace dovetail::work_precision
