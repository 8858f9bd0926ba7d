#include <fmt/format.h>

#include <cmath>

#include "core/replace_file.hpp"
#include "studies/report/pages/html.hpp"
#include "studies/report/pages/page_style.hpp"
#include "studies/report/pages/units.hpp"
#include "studies/report/plots/svg_plot.hpp"
#include "studies/work_precision/figures.hpp"
#include "studies/work_precision/results.hpp"

namespace dovetail::work_precision {
namespace {

using report::escape;

constexpr const char* kStyle = R"(
.three{display:grid;grid-template-columns:repeat(auto-fit,minmax(min(100%,19rem),1fr));gap:.9rem;margin-top:.6rem}
.three figure{padding:.8rem .8rem .6rem}h3.sweep{margin:2rem 0 .2rem}h4{font-size:.9rem;font-weight:600;margin:0 0 .3rem}
.three+details{margin-top:.5rem}section>ul.legend{margin:.5rem 0 0}p.verdict{max-width:62rem}
)";

std::string cell(double value, const char* format) {
  return std::isfinite(value) ? fmt::format(fmt::runtime(format), value) : "\u2013";
}

std::string row(const std::vector<std::string>& cells) {
  std::string text = "<tr>";
  for (std::size_t i = 0; i < cells.size(); ++i)
    text += i == 0 ? "<th scope=\"row\">" + escape(cells[i]) + "</th>" : "<td>" + escape(cells[i]) + "</td>";
  return text + "</tr>\n";
}

std::string head(const std::vector<std::string>& cells) {
  std::string text = "<div class=\"scroll\"><table><thead><tr>";
  for (const std::string& one : cells) text += "<th scope=\"col\">" + escape(one) + "</th>";
  return text + "</tr></thead><tbody>\n";
}

constexpr const char* kTableEnd = "</tbody></table></div>\n";

std::string numbers(const Sweep& sweep) {
  std::string text = "<details class=\"numbers\"><summary>Numbers</summary>" +
                     head({"setting", "resonance (s)", "model (s)", "Jacobians", "frequency (rad/s)", "energy (J)",
                           "amplitude", "error of frequency", "of energy", "of amplitude", "status"});
  for (const Line& line : sweep.lines)
    for (const Point& point : line.points) {
      const Run& run = point.run;
      std::vector<std::string> cells{
          line.name + (line.name.empty() ? "" : ", ") + point.label + (point.is_default ? " (default)" : ""),
          cell(run.seconds, "{:.3g}"), run.model_seconds > 0 ? cell(run.model_seconds, "{:.3g}") : "\u2013",
          std::to_string(run.jacobians)};
      for (const double value : run.value) cells.push_back(run.converged() ? cell(value, "{:.9g}") : "\u2013");
      for (const double error : point.error) cells.push_back(cell(error, "{:.2e}"));
      cells.push_back(run.status);
      text += row(cells);
    }
  return text + kTableEnd + "</details>\n";
}

std::string settings_words(const Run& run, bool meshed) {
  const Setting& s = run.setting;
  std::string text = fmt::format("H = {}, N = {}", s.harmonics, s.samples);
  if (s.penalty != 1) text += fmt::format(", {:g} eps", s.penalty);
  if (meshed) text += fmt::format(", {} modes, {} edges", s.modes, s.flank_elements);
  return text;
}

std::string reference_table(const Diagram& diagram) {
  const bool meshed = diagram.mesh_reference.has_value();
  std::string text = head({"reference", "resonance (rad/s)", "energy (J)", "amplitude", "seconds"});
  const auto add = [&](const std::string& name, const Reference& reference) {
    const auto values = [&](const std::string& what, const Run& run) {
      text += row({what + ": " + settings_words(run, meshed), cell(run.value[0], "{:.9g}"),
                   cell(run.value[1], "{:.9g}"), cell(run.value[2], "{:.9g}"),
                   run.converged() ? cell(run.seconds + run.model_seconds, "{:.3g}") : run.status});
    };
    values(name, reference.run);
    values("Check", reference.check);
    text += row({"They agree to", cell(reference.agreement[0], "{:.1e}"), cell(reference.agreement[1], "{:.1e}"),
                 cell(reference.agreement[2], "{:.1e}"), ""});
  };
  add("Reference", diagram.reference);
  if (diagram.mesh_reference) add("For the mesh", *diagram.mesh_reference);
  return text + kTableEnd;
}

std::string sweep_section(const Diagram& diagram, const Sweep& sweep) {
  std::string text = "<h3 class=\"sweep\">" + escape(sweep.title) + "</h3>\n<p class=\"verdict\">" +
                     escape(verdict(sweep, kGoal)) + "</p>\n";
  std::string drawings;
  for (std::size_t q = 0; q < kQuantities.size(); ++q) {
    const report::Plot plot = error_plot(diagram, sweep, q);
    if (q == 0) text += report::plot_legend(plot);
    drawings += "<figure><h4>" + escape(plot.title) + "</h4>" +
                (report::is_empty(plot) ? "<p>Nothing converged.</p>" : report::plot_svg(plot)) + "</figure>\n";
  }
  return text + "<div class=\"three\">" + drawings + "</div>\n" + numbers(sweep);
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

std::string growth_section(const std::vector<Growth>& growths) {
  std::string text =
      "<section id=\"newton-step\"><h2>Growth of a Newton step</h2>\n<p>Residual, exact derivative, "
      "condensed Jacobian, factorisation and solution at a converged state of contact patches with three "
      "directions per node, beside a dense LU of all unknowns.";
  for (const Growth& growth : growths)
    text += fmt::format(
        " Between the last two points over {} the step grows with the power {:.1f}, the residual with its "
        "derivative with {:.1f} and the full LU with {:.1f}.",
        escape(growth.title), exponent(growth, &StepTimes::step), exponent(growth, &StepTimes::derivative),
        exponent(growth, &StepTimes::lu));
  text += "</p>\n";
  std::string drawings,
      table = head({"over", "nodes", "H", "N", "unknowns", "factorised", "residual (ms)", "with D (ms)", "dense J (ms)",
                    "full LU (ms)", "condensed J and LU (ms)", "solve (ms)", "Newton step (ms)"});
  for (const Growth& growth : growths) {
    const report::Plot plot = growth_plot(growth);
    if (&growth == &growths.front()) text += report::plot_legend(plot);
    drawings += "<figure><h4>" + escape(plot.title) + "</h4>" + report::plot_svg(plot) + "<figcaption>" +
                escape(plot.description) + "</figcaption></figure>\n";
    for (const StepTimes& t : growth.times) {
      std::vector<std::string> cells{growth.title,
                                     std::to_string(t.nodes),
                                     std::to_string(t.harmonics),
                                     std::to_string(t.samples),
                                     std::to_string(t.unknowns),
                                     std::to_string(t.factorised)};
      for (const double part : {t.residual, t.derivative, t.jacobian, t.lu, t.linearise, t.solve, t.step})
        cells.push_back(t.status == Status::converged ? fmt::format("{:.3g}", 1e3 * part) : "failed");
      table += row(cells);
    }
  }
  return text + "<div class=\"three\">" + drawings + "</div>\n<details class=\"numbers\"><summary>Numbers</summary>" +
         table + kTableEnd + "</details>\n</section>\n";
}

std::string provenance(const Circumstances& made) {
  std::string text = "<section><h2>Provenance</h2>\n<dl>\n";
  const auto entry = [&](const char* name, const std::string& value) {
    text += fmt::format("<dt>{}</dt><dd>{}</dd>\n", name, escape(value));
  };
  entry("Commit", made.commit);
  entry("Machine", made.machine);
  entry("System", made.system);
  entry("Linear algebra", made.blas);
  entry("Compiler", made.compiler);
  entry("Date", made.date_utc);
  entry("Time taken", fmt::format("{:.0f} s", made.seconds));
  return text +
         "</dl>\n<p class=\"soft\">The numbers are in table.csv, growth.csv and table.json beside this "
         "page.</p></section>\n";
}

}  // namespace

std::string page_html(const Results& results) {
  std::string text = report::page_begin("Speed against error \u2013 dovetail", kStyle);
  text +=
      "<header>\n<h1>Speed against error</h1>\n<p class=\"lead\">What each setting of the contact engine costs and "
      "errs, and where its defaults stand</p>\n";
  if (results.made.quick)
    text += "<p class=\"flag\">A quick look with small models and few settings: no evidence for any default.</p>\n";
  text +=
      "<p>One setting is varied at a time, all others keep their defaults. Errors are those of the resonance "
      "frequency, the energy friction dissipates per cycle and the peak amplitude, relative to a reference that is "
      "finer in everything; a second one, fine in another way, says how good the first is. References use the "
      "second-order slip return. Seconds are processor "
      "time of one core, the median of repetitions. The star is the default of the program; a cross along the upper "
      "edge is a run that failed, at the time it took to fail.</p>\n</header>\n";
  for (const Diagram& diagram : results.diagrams) text += diagram_section(diagram);
  text += growth_section(results.growth) + provenance(results.made);
  return text + report::kPageEnd;
}

void write(const std::filesystem::path& folder, const Results& results) {
  std::error_code ignored;  // what is missing is named when a file cannot be written
  std::filesystem::create_directories(folder, ignored);
  replace_file(folder / "table.csv", table_csv(results));
  replace_file(folder / "growth.csv", growth_csv(results));
  replace_file(folder / "table.json", table_json(results));
  replace_file(folder / "index.html", page_html(results));
}

}  // namespace dovetail::work_precision
