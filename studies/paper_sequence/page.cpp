#include "studies/paper_sequence/page.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "studies/paper_sequence/figures.hpp"
#include "studies/paper_sequence/findings.hpp"
#include "studies/paper_sequence/scene_words.hpp"
#include "studies/report/pages/html.hpp"
#include "studies/report/pages/page_style.hpp"
#include "studies/report/pages/units.hpp"
#include "studies/report/plots/report_plots.hpp"
#include "studies/report/plots/section_drawing.hpp"
#include "studies/report/plots/svg_plot.hpp"

namespace dovetail::paper_sequence {
namespace {

using report::escape;
using report::significant;

constexpr const char* kStyle = R"(
table.findings{width:100%}table.findings td,table.findings th{white-space:normal;text-align:left;vertical-align:top}
table.findings td:first-child{width:30%}table.findings td:last-child,table.findings th:last-child{padding-right:0;width:7.5rem}
.verdict{font-size:.84rem;font-weight:600;white-space:nowrap}.holds{color:var(--after)}.partly{color:var(--soft)}.fails{color:var(--bad)}
.beside{display:grid;grid-template-columns:repeat(auto-fit,minmax(min(100%,20rem),1fr));gap:.2rem 2rem;margin:.2rem 0 1rem}
.beside h4{margin:0;font-size:.84rem;color:var(--soft);font-weight:600}.beside p{margin:.1rem 0 .4rem}
@media(max-width:640px){table.findings,table.findings tbody,table.findings tr,table.findings td{display:block;width:auto!important}
table.findings thead{display:none}table.findings td{border:0;padding:.1rem 0}table.findings tr{border-bottom:1px solid var(--hair);padding:.4rem 0}}
)";

constexpr const char* kDifferences =
    "<li>Its wear history stops at a number of cycles; here the state at rest is also found directly.</li>\n"
    "<li>Contact nodes carry no mass here, and wear follows from the slip between samples instead of the velocity of "
    "the truncated series: stuck nodes do not wear.</li>\n"
    "<li>Its axes are normalised and its dimensions are not given, so magnitudes are not compared.</li>\n"
    "<li>Its damping besides friction is not given. It was chosen low here, so that 0.5\u00a0N slide a strip of the "
    "flanks; with 0.1\u00a0% of critical they slide far less, and friction takes little off the peak.</li>\n";

const char* style_class(Verdict verdict) {
  return verdict == Verdict::holds ? "holds" : verdict == Verdict::partly ? "partly" : "fails";
}

std::string badge(Verdict verdict) {
  return fmt::format("<span class=\"verdict {}\">{}</span>", style_class(verdict), to_string(verdict));
}

std::string figure_html(const Figure& figure) {
  return figure.map ? report::flank_map_figure(*figure.map) : report::plot_figure(figure.plot);
}

std::string figures_of(const std::vector<Figure>& figures) {
  std::string text = "<div class=\"grid2\">\n";
  for (const Figure& figure : figures) text += figure_html(figure);
  return text + "</div>\n";
}

/// What the reference says beside what is found here, for the findings of these keys.
std::string beside(const std::vector<Finding>& all, const std::vector<std::string>& keys) {
  std::string text;
  for (const Finding& f : all) {
    if (std::find(keys.begin(), keys.end(), f.key) == keys.end()) continue;
    text += "<div class=\"beside\"><div><h4>The reference</h4><p>" + escape(f.paper) +
            "</p></div><div><h4>Here: " + badge(f.verdict) + "</h4><p>" + escape(f.here) + "</p>" +
            (f.why.empty() ? "" : "<p class=\"soft\">" + escape(f.why) + "</p>") + "</div></div>\n";
  }
  return text;
}

std::string plain_beside(const std::string& paper, const std::string& here) {
  return "<div class=\"beside\"><div><h4>The reference</h4><p>" + escape(paper) + "</p></div><div><h4>Here</h4><p>" +
         escape(here) + "</p></div></div>\n";
}

std::string finding_table(const std::vector<Finding>& all, const SceneWords& words) {
  std::string text = "<table class=\"findings\"><thead><tr><th>The reference</th><th>" + words.column +
                     "</th><th></th></tr></thead><tbody>\n";
  for (const Finding& f : all)
    text +=
        "<tr><td>" + escape(f.paper) + "</td><td>" + escape(f.here) + "</td><td>" + badge(f.verdict) + "</td></tr>\n";
  return text + "</tbody></table>\n";
}

std::string lead(const std::vector<Finding>& all, const SceneWords& words) {
  const auto count = [&](Verdict verdict) {
    return std::count_if(all.begin(), all.end(), [&](const Finding& f) { return f.verdict == verdict; });
  };
  std::string text =
      fmt::format("{} of the reference\u2019s {} findings hold in {}", count(Verdict::holds), all.size(), words.where);
  if (count(Verdict::partly) > 0) text += fmt::format(", {} in part", count(Verdict::partly));
  if (count(Verdict::fails) > 0) text += fmt::format(", {} not", count(Verdict::fails));
  return text;
}

std::string provenance(const Results& r) {
  const report::Provenance made = report::provenance();
  std::string text = "<section><h2>Provenance</h2>\n<dl>\n";
  const auto entry = [&](const char* name, const std::string& value) {
    text += fmt::format("<dt>{}</dt><dd>{}</dd>\n", name, escape(value));
  };
  entry("Time taken", fmt::format("{} s", significant(r.seconds, 3)));
  entry("History",
        fmt::format("{} steps, {} steady states, {} Jacobians",
                    r.history.cycles.empty() ? 0 : r.history.cycles.size() - 1, r.history.solves, r.history.jacobians));
  entry("Commit", r.commit);
  entry("Compiler", made.compiler);
  entry("Date", made.date_utc);
  return text + "</dl>\n<details><summary>Study file</summary><pre>" + escape(r.study_text) +
         "</pre></details>\n<p class=\"soft\">The numbers of every figure are in the CSV files, everything in SI units "
         "in "
         "results.json, the findings in findings.json beside this page.</p></section>\n";
}

std::string opening(const Results& r, const std::vector<Finding>& all, const SceneWords& words) {
  std::string text = "<header>\n<h1>Dynamics and fretting wear of a bladed disk, " + words.title +
                     "</h1>\n<p class=\"lead\">" +
                     escape(all.empty() ? "The sequence could not be computed" : lead(all, words)) + "</p>\n";
  if (r.quick) text += "<p class=\"flag\">A quick look on a coarse mesh with few steps: no evidence.</p>\n";
  text +=
      "<p>Salles, Blanc, Thouverez, Gouskov and Jean (ASME Turbo Expo 2009) computed vibration and fretting wear of a "
      "titanium bladed disk with 47 sectors together. This page repeats their sequence of figures in " +
      words.such +
      ": friction 0.5, 0.5 N at the blade\u2019s top, first flexural mode without nodal diameters, 3 "
      "harmonics, 128 samples, wear coefficient 10\u207b\u00b9\u2074 Pa\u207b\u00b9. Their dimensions, speed and "
      "damping are "
      "not given, and their axes are normalised, so only what happens can be compared, not how much.</p>\n";
  for (const std::string& failure : r.failures) text += "<p class=\"flag\">" + escape(failure) + "</p>\n";
  return text + "</header>\n";
}

}  // namespace

std::string page_html(const Results& r) {
  const std::vector<Finding> all = findings(r);
  const SceneWords& words = scene_words(r.scene);
  std::string text =
      report::page_begin("The reference " + words.title + " \u2013 dovetail", kStyle) + opening(r, all, words);
  if (!all.empty()) text += "<section><h2>Findings</h2>\n" + finding_table(all, words) + "</section>\n";
  if (!r.design.contact.flank.empty()) {
    text += "<section><h2>The disk and its preload</h2>\n" +
            plain_beside(
                "Natural frequencies over nodal diameters (fig. 3), and the contact pressures of the centrifugal "
                "load on both sides of the root (fig. 5), computed by the quasi-static form of the method.",
                frequency_text(r) + " " + pressure_text(r)) +
            figures_of({nodal_diameter_figure(r), pressure_figure(r)}) + "</section>\n";
    text += "<section><h2>Vibration before wear</h2>\n" + beside(all, {"friction_damps", "power_peaks_at_resonance"}) +
            figures_of({damping_figure(r), power_figure(r)}) + "</section>\n";
    text += "<section><h2>Wear at the unworn resonance</h2>\n" +
            plain_beside("Maps of the first cycle\u2019s rates over both sides, normalised by the largest (fig. 8).",
                         first_rate_text(r)) +
            beside(all, {"rates_rise_peak_vanish", "wear_comes_to_rest"}) +
            figures_of({first_rate_figure(r), volume_figure(r), depth_course_figure(r), rate_course_figure(r)}) +
            "</section>\n";
    text += "<section><h2>The final shape</h2>\n" + beside(all, {"depths_of_microns", "profiles_asymmetric"}) +
            "<div class=\"grid2\">\n" + figure_html(profile_figure(r)) + report::joint_figure(r.design, nullptr) +
            "</div>\n</section>\n";
    text +=
        "<section><h2>Vibration as the joint wears</h2>\n" +
        beside(all, {"amplitude_falls_at_unworn_resonance", "peak_moves_down", "peak_grows"}) +
        figures_of({wearing_response_figure(r), wearing_power_figure(r), amplitude_course_figure(r), drift_figure(r)}) +
        "</section>\n";
  }
  if (!r.convergence.empty())
    text +=
        "<section><h2>Convergence</h2>\n<p>One setting changed at a time; changes against the study\u2019s own, in "
        "bold.</p>\n" +
        convergence_table(r.convergence) + "</section>\n";
  return text + "<section><h2>Where the two differ</h2>\n<ul>\n" + words.differences + kDifferences +
         "</ul>\n</section>\n" + provenance(r) + report::kPageEnd;
}

}  // namespace dovetail::paper_sequence
