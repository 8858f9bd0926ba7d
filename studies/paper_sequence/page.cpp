#include "studies/paper_sequence/page.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "studies/paper_sequence/figures.hpp"
#include "studies/paper_sequence/findings.hpp"
#include "studies/report/html.hpp"
#include "studies/report/page_style.hpp"
#include "studies/report/report_plots.hpp"
#include "studies/report/section_drawing.hpp"
#include "studies/report/svg_plot.hpp"
#include "studies/report/units.hpp"

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
    "<section><h2>Where the two differ</h2>\n<ul>\n"
    "<li>The reference is a model in space; this is a plane section, uniform along the slot.</li>\n"
    "<li>Its wear history stops at a number of cycles; here the state at rest is also found directly.</li>\n"
    "<li>Contact nodes carry no mass here, and wear follows from the slip between samples instead of the velocity of "
    "the "
    "truncated series: stuck nodes do not wear.</li>\n"
    "<li>Its axes are normalised and its dimensions are not given, so magnitudes are not compared.</li>\n"
    "<li>Its damping besides friction is not given. It was chosen low here, so that 0.5\u00a0N slide a strip of the "
    "flanks; "
    "with 0.1\u00a0% of critical they slide no more than a tenth of a millimetre or two, and friction takes 1 to "
    "2\u00a0% off "
    "the peak.</li>\n"
    "</ul>\n</section>\n";

const char* style_class(Verdict verdict) {
  return verdict == Verdict::holds ? "holds" : verdict == Verdict::partly ? "partly" : "fails";
}

std::string badge(Verdict verdict) {
  return fmt::format("<span class=\"verdict {}\">{}</span>", style_class(verdict), to_string(verdict));
}

std::string figures_of(const std::vector<Figure>& figures) {
  std::string text = "<div class=\"grid2\">\n";
  for (const Figure& figure : figures) text += report::plot_figure(figure.plot);
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

std::string finding_table(const std::vector<Finding>& all) {
  std::string text =
      "<table class=\"findings\"><thead><tr><th>The reference</th><th>The plane section</th><th></th></tr></thead>"
      "<tbody>\n";
  for (const Finding& f : all)
    text +=
        "<tr><td>" + escape(f.paper) + "</td><td>" + escape(f.here) + "</td><td>" + badge(f.verdict) + "</td></tr>\n";
  return text + "</tbody></table>\n";
}

std::string lead(const std::vector<Finding>& all) {
  const auto count = [&](Verdict verdict) {
    return std::count_if(all.begin(), all.end(), [&](const Finding& f) { return f.verdict == verdict; });
  };
  std::string text = fmt::format("{} of the reference\u2019s {} findings hold in a plane section of its joint",
                                 count(Verdict::holds), all.size());
  if (count(Verdict::partly) > 0) text += fmt::format(", {} in part", count(Verdict::partly));
  if (count(Verdict::fails) > 0) text += fmt::format(", {} not", count(Verdict::fails));
  return text;
}

std::string pressure_text(const Results& r) {
  const report::ContactRecord& contact = r.design.contact;
  double force = 0, area = 0;
  int open = 0;
  for (std::size_t i = 0; i < contact.preload_pressure_pa.size(); ++i) {
    force += contact.preload_pressure_pa[i] * contact.area_m2[i];
    area += contact.area_m2[i];
    if (!(contact.preload_pressure_pa[i] > 0)) ++open;
  }
  const std::string where =
      open == 0 ? fmt::format(
                      "All {} contact nodes touch; on the neck side, where the hoop growth of the disk opens the "
                      "slot, they are pressed least.",
                      contact.flank.size())
                : fmt::format(
                      "{} of {} contact nodes do not touch: the hoop growth of the disk opens the slot on the "
                      "neck side.",
                      open, contact.flank.size());
  return fmt::format(
      "The mean pressure is {}\u00a0MPa, the largest {}\u00a0MPa at the flank\u2019s root-side end. {} Both flanks are "
      "alike, as the section is its own mirror image.",
      significant(force / area / 1e6, 3), significant(largest_of(contact.preload_pressure_pa).value / 1e6, 3), where);
}

std::string frequency_text(const Results& r) {
  const report::NodalDiameterRecord& record = r.design.nodal_diameters;
  if (record.frequency_hz.empty() || record.modes < 1) return "The frequencies were not computed.";
  const auto modes = static_cast<std::size_t>(record.modes);
  const double at_zero = record.frequency_hz.front();
  const double at_most = record.frequency_hz[(record.nodal_diameter.size() - 1) * modes];
  return fmt::format(
      "The first family, the flexural mode of the blade, goes from {} Hz without nodal diameters to {} Hz with {}; the "
      "wear computations are for none, at {} Hz with friction. The section carries bending in its own plane only: "
      "families of torsion and edgewise bending are missing.",
      significant(at_zero, 5), significant(at_most, 5), record.nodal_diameter.back(), significant(r.resonance_hz, 6));
}

std::string first_rate_text(const Results& r) {
  const Numbers& rate = r.design.contact.wear_rate_m_per_cycle;
  const double most = largest_of(rate).value;
  const auto wearing = std::count_if(rate.begin(), rate.end(), [&](double v) { return v > 0.01 * most; });
  return fmt::format(
      "{} of {} contact nodes wear by more than a hundredth of the largest rate, all next to the neck-side "
      "ends of the flanks; the others stick.",
      wearing, rate.size());
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

std::string opening(const Results& r, const std::vector<Finding>& all) {
  std::string text =
      "<header>\n<h1>Dynamics and fretting wear of a bladed disk, in a plane section</h1>\n<p class=\"lead\">" +
      escape(all.empty() ? "The sequence could not be computed" : lead(all)) + "</p>\n";
  if (r.quick) text += "<p class=\"flag\">A quick look on a coarse mesh with few steps: no evidence.</p>\n";
  text +=
      "<p>Salles, Blanc, Thouverez, Gouskov and Jean (ASME Turbo Expo 2009) computed vibration and fretting wear of a "
      "titanium bladed disk with 47 sectors together. This page repeats their sequence of figures in a plane section "
      "of "
      "such a joint: friction 0.5, 0.5 N at the blade\u2019s top, first flexural mode without nodal diameters, 3 "
      "harmonics, 128 samples, wear coefficient 10\u207b\u00b9\u2074 Pa\u207b\u00b9. Their dimensions, speed and "
      "damping are "
      "not given, and their axes are normalised, so only what happens can be compared, not how much.</p>\n";
  for (const std::string& failure : r.failures) text += "<p class=\"flag\">" + escape(failure) + "</p>\n";
  return text + "</header>\n";
}

}  // namespace

std::string page_html(const Results& r) {
  const std::vector<Finding> all = findings(r);
  std::string text =
      "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"/>\n"
      "<meta name=\"viewport\" content=\"width=device-width,initial-scale=1\"/>\n<title>The reference in a plane "
      "section "
      "\u2013 dovetail</title>\n<style>" +
      report::plot_style() + report::page_style() + kStyle + "</style></head>\n<body><main>\n" + opening(r, all);
  if (!all.empty()) text += "<section><h2>Findings</h2>\n" + finding_table(all) + "</section>\n";
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
            "<div class=\"grid2\">\n" + report::plot_figure(profile_figure(r).plot) +
            report::joint_figure(r.design, nullptr) + "</div>\n</section>\n";
    text +=
        "<section><h2>Vibration as the joint wears</h2>\n" +
        beside(all, {"amplitude_falls_at_unworn_resonance", "peak_moves_down", "peak_grows"}) +
        figures_of({wearing_response_figure(r), wearing_power_figure(r), amplitude_course_figure(r), drift_figure(r)}) +
        "</section>\n";
  }
  return text + kDifferences + provenance(r) + "</main></body></html>\n";
}

}  // namespace dovetail::paper_sequence
