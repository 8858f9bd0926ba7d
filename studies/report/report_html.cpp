#include "studies/report/report_html.hpp"

#include <fmt/format.h>

#include <utility>

#include "core/replace_file.hpp"
#include "studies/report/html.hpp"
#include "studies/report/report_plots.hpp"
#include "studies/report/report_tables.hpp"
#include "studies/report/report_words.hpp"
#include "studies/report/section_drawing.hpp"
#include "studies/report/svg_plot.hpp"

namespace dovetail::report {

namespace {

constexpr const char* kPageStyle = R"(
*{box-sizing:border-box}
body{margin:0;background:var(--paper);color:var(--ink);font:16px/1.5 system-ui,-apple-system,"Segoe UI",Roboto,sans-serif}
main{max-width:1120px;margin:0 auto;padding:2.2rem 1.4rem 4rem}
h1{font-size:1.1rem;font-weight:600;color:var(--soft);margin:0 0 .5rem}
.lead{font-size:1.5rem;line-height:1.32;font-weight:600;margin:0 0 .7rem;max-width:52rem;text-wrap:pretty}
h2{font-size:1.2rem;margin:2.6rem 0 .8rem;padding-top:1.1rem;border-top:1px solid var(--hair)}
h3{font-size:1rem;margin:0 0 .35rem}h3.above{margin-top:1.6rem}.grid2+.grid2{margin-top:1.1rem}ul+.grid2{margin-top:1rem}p{margin:.4rem 0;max-width:52rem}ul{padding-left:1.2rem;margin:.4rem 0}
.soft,figcaption,td .soft{color:var(--soft)}figcaption{font-size:.86rem;margin-top:.3rem;max-width:52rem}figure>details{margin-top:auto;padding-top:.5rem}
.grid2{display:grid;grid-template-columns:repeat(auto-fit,minmax(min(100%,28rem),1fr));gap:1.1rem}
.shape{display:grid;grid-template-columns:minmax(0,3.3fr) minmax(0,1fr);gap:1.1rem;align-items:stretch}
figure{margin:0;display:flex;flex-direction:column;background:var(--card);border:1px solid var(--hair);border-radius:8px;padding:1rem 1.1rem .8rem;min-width:0}
figure.nothing p{color:var(--soft)}
.scroll{overflow-x:auto;-webkit-overflow-scrolling:touch}
table{border-collapse:collapse;font-size:.92rem;font-variant-numeric:tabular-nums}
th,td{padding:.32rem .9rem .32rem 0;text-align:right;border-bottom:1px solid var(--hair);white-space:nowrap;font-weight:400}
thead th{color:var(--soft);font-size:.84rem;vertical-align:bottom}tbody th,th:first-child,td.text,th.text{text-align:left}
table.pair{width:100%}table.figures tbody th::first-letter{text-transform:uppercase}
tr.aim th,tr.aim td{font-weight:600}tr.aim th{color:var(--after)}tr.soft td{color:var(--soft)}
.flag{color:var(--bad);font-size:.84rem}code,pre{font:.84rem/1.5 ui-monospace,"DejaVu Sans Mono",Menlo,monospace}
pre{overflow-x:auto;background:var(--card);border:1px solid var(--hair);border-radius:8px;padding:.9rem;margin:.6rem 0}
details{margin:.6rem 0 0}summary{cursor:pointer;color:var(--soft);font-size:.86rem}details table{margin-top:.5rem}
details.numbers .scroll{max-height:18rem;overflow-y:auto}
dl{display:grid;grid-template-columns:max-content 1fr;gap:.2rem 1.2rem;margin:.4rem 0}dt{color:var(--soft)}dd{margin:0;overflow-wrap:anywhere}
svg.drawing{display:block;width:100%;height:auto;max-height:32rem}
.sector svg.drawing{max-height:26rem}
.blade,.disk,.ghost,.form,.bar{vector-effect:non-scaling-stroke;stroke-linejoin:round}
.blade{fill:var(--wash);stroke:var(--after);stroke-width:1.6}.disk{fill:var(--steel);stroke:var(--base);stroke-width:1.2}
.ghost{fill:none;stroke:var(--before);stroke-width:1}.form{fill:var(--after);fill-opacity:.55;stroke:none}
.bar{fill:none;stroke:var(--soft);stroke-width:1.2}svg.drawing text{fill:var(--soft);font-family:system-ui,sans-serif}
ul.legend .blade,ul.legend .disk{stroke-width:1}
@media(max-width:640px){svg.plot text{font-size:15px}
table.pair,table.pair tbody{display:block}table.pair thead{display:none}
table.pair tr{display:grid;grid-template-columns:1fr 1fr;gap:0 .6rem;padding:.35rem 0;border-bottom:1px solid var(--hair)}
table.pair th,table.pair td{border:0;padding:0;text-align:left;white-space:normal}
table.pair td:nth-child(2){grid-area:2/1}table.pair td:nth-child(3){grid-area:2/2}table.pair td:nth-child(4){grid-area:1/2;text-align:right}
table.pair td:nth-child(2)::before{content:"before ";color:var(--soft);font-weight:400}
table.pair td:nth-child(3)::before{content:"after ";color:var(--soft);font-weight:400}
main{padding:1.3rem .9rem 3rem}.lead{font-size:1.2rem}.shape{grid-template-columns:1fr}
.sector svg.drawing{max-height:20rem}figure{padding:.8rem .7rem .6rem}dl{grid-template-columns:1fr}dd{margin-bottom:.4rem}}
@media print{figure,table{break-inside:avoid}details.numbers{display:none}}
)";

std::string figures(const std::vector<Plot>& plots) {
  std::string text = "<div class=\"grid2\">\n";
  for (const Plot& plot : plots) text += plot_figure(plot);
  return text + "</div>\n";
}

/// The designs there are to show: the best with the start behind it, or the start alone.
Comparison designs_of(const RunRecord& record) {
  if (!record.best_design)
    return {.before = nullptr, .after = record.baseline_design ? &*record.baseline_design : nullptr};
  const bool same = record.best == record.baseline;
  return {.before = record.baseline_design && !same ? &*record.baseline_design : nullptr,
          .after = &*record.best_design};
}

std::string opening(const RunRecord& record) {
  const std::string name = record.title.empty() ? record.name : record.title;
  std::string text =
      "<header>\n<h1>" + escape(name) + "</h1>\n<p class=\"lead\">" + escape(headline(record)) + "</p>\n";
  const std::vector<std::string> held = holding(record);
  if (!held.empty())
    text += "<p>The best design is held by " + escape(listed(held)) + ".</p>\n";
  else if (record.best)
    text += "<p>No limit, rule or bound holds the best design: it lies inside of all of them.</p>\n";
  return text + "<p class=\"soft\">" + escape(ending(record)) + "</p>\n</header>\n";
}

std::string notes(const Comparison& designs) {
  std::string text;
  for (const DesignRecord* design : {designs.before, designs.after}) {
    if (!design) continue;
    for (const std::string& note : design->notes)
      text += "<p class=\"soft\">" +
              std::string(!designs.before            ? ""
                          : design == designs.before ? "Before: "
                                                     : "After: ") +
              escape(note) + "</p>\n";
  }
  return text;
}

std::string shape_section(const Comparison& designs) {
  return "<section><h2>Shape</h2>\n<div class=\"shape\">" + joint_figure(*designs.after, designs.before) +
         sector_figure(*designs.after, designs.before) + "</div>\n</section>\n";
}

std::string contact_section(const Comparison& designs) {
  std::string text =
      "<section><h2>Contact, wear and stress</h2>\n" +
      figures({wear_depth_plot(designs), pressure_plot(designs), gap_plot(designs), fillet_plot(designs)});
  return text + "</section>\n";
}

std::string vibration_section(const Comparison& designs) {
  return "<section><h2>Vibration</h2>\n" + figures({response_plot(designs), nodal_diameter_plot(*designs.after)}) +
         "</section>\n";
}

std::string history_section(const DesignRecord& design) {
  std::string text = "<section><h2>Wear history</h2>\n";
  if (!design.history || design.history->cycles.empty())
    return text + "<p>No wear history was computed: the asymptotic wear above is found directly.</p>\n</section>\n";
  if (design.history->status != "converged")
    text += "<p>The history ended early (" + escape(design.history->status) + ").</p>\n";
  return text +
         figures({history_plot(design), history_depth_plot(design), history_amplitude_plot(design),
                  history_profile_plot(design)}) +
         "</section>\n";
}

std::string search_section(const RunRecord& record) {
  std::string text = "<section><h2>Search</h2>\n" + problem_list(record);
  if (record.evaluations.empty()) return text + "<p>There are no candidates to show.</p>\n</section>\n";
  std::vector<Plot> plots{objective_plot(record)};
  for (Plot& plot : limit_plots(record)) plots.push_back(std::move(plot));
  return text + figures(plots) + "<h3 class=\"above\">Design variables</h3>\n" + variable_table(record) +
         evaluation_table(record) + "</section>\n";
}

constexpr const char* kLimits =
    "<p>A plane section of one sector stands for the joint, with Coulomb friction and Archard wear of constant "
    "coefficients: "
    "skewed slots, bending out of the plane, temperature and debris are not in it, and measured wear coefficients "
    "scatter "
    "by about half. The error bars cover harmonics, samples, the reduction and the edge of the worn zone, but neither "
    "the "
    "finite-element mesh nor the laws themselves, so trust differences between designs more than absolute "
    "depths.</p>\n";

}  // namespace

std::string report_html(const RunRecord& record) {
  const std::string name = record.title.empty() ? record.name : record.title;
  std::string text =
      "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"/>\n"
      "<meta name=\"viewport\" content=\"width=device-width,initial-scale=1\"/>\n<title>" +
      escape(name.empty() ? "dovetail" : name + " \u2013 dovetail") + "</title>\n<style>" + plot_style() + kPageStyle +
      "</style></head>\n<body><main>\n";
  text += opening(record);
  text += "<section><h2>Key figures</h2>\n" + key_figures(record) + "</section>\n";
  const Comparison designs = designs_of(record);
  if (designs.after) {
    text += shape_section(designs) + contact_section(designs) + vibration_section(designs) +
            history_section(*designs.after) + notes(designs);
  } else {
    text +=
        "<section><h2>Designs</h2>\n<p>No design could be computed in full, so there are no shapes or curves to "
        "show.</p>\n</section>\n";
  }
  text += search_section(record);
  text += std::string("<section><h2>Limits of the model</h2>\n") + kLimits + "</section>\n";
  text += "<section><h2>Provenance</h2>\n" + provenance_section(record) + "</section>\n";
  return text + "</main></body></html>\n";
}

void write_report(const std::filesystem::path& file, const RunRecord& record) {
  replace_file(file, report_html(record));
}

}  // namespace dovetail::report
