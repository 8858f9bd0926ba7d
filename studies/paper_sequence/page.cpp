#include "studies/paper_sequence/page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "studies/paper_sequence/figures.hpp"
#include "studies/paper_sequence/findings.hpp"
#include "studies/paper_sequence/scene_words.hpp"
#include "studies/paper_sequence/texts.hpp"
#include "studies/report/pages/page.hpp"
#include "studies/report/plots/section_drawing.hpp"
#include "studies/report/words/table.hpp"
#include "studies/report/words/units.hpp"

namespace dovetail::paper_sequence {
namespace {

using report::escape;
using report::significant;

/// The keys a page has places for.
constexpr std::array kFindings{"friction_damps",
                               "power_peaks_at_resonance",
                               "rates_rise_peak_vanish",
                               "wear_comes_to_rest",
                               "depths_of_microns",
                               "profiles_asymmetric",
                               "amplitude_falls_at_unworn_resonance",
                               "peak_moves_down",
                               "peak_grows"};

report::Html badge(Verdict verdict) {
  constexpr std::array kStyles{"holds", "partly", "fails"};
  return {fmt::format("<span class=\"verdict {}\">{}</span>", kStyles[static_cast<std::size_t>(verdict)],
                      to_string(verdict))};
}

/// What the reference says beside what is found here.
std::string beside(const Finding& f) {
  return "<div class=\"beside\"><div><h4>The reference</h4><p>" + escape(f.paper) +
         "</p></div><div><h4>Here: " + badge(f.verdict).text + "</h4><p>" + escape(f.here) + "</p>" +
         (f.why.empty() ? "" : "<p class=\"soft\">" + escape(f.why) + "</p>") + "</div></div>\n";
}

std::string finding_table(const std::vector<Finding>& all, const SceneWords& words) {
  if (all.empty()) return {};
  report::Table table{
      .columns = {{"The reference"}, {words.column}, {""}}, .rows = {}, .style = "findings", .named_rows = false};
  for (const Finding& f : all) table.rows.push_back({{f.paper, f.here, badge(f.verdict)}});
  return table_html(table);
}

std::string lead(const std::vector<Finding>& all, const SceneWords& words) {
  if (all.empty()) return {};
  const auto count = [&](Verdict verdict) {
    return std::count_if(all.begin(), all.end(), [&](const Finding& f) { return f.verdict == verdict; });
  };
  std::string text =
      fmt::format("{} of the reference\u2019s {} findings hold in {}", count(Verdict::holds), all.size(), words.where);
  if (count(Verdict::partly) > 0) text += fmt::format(", {} in part", count(Verdict::partly));
  if (count(Verdict::fails) > 0) text += fmt::format(", {} not", count(Verdict::fails));
  return text;
}

void add_findings(const std::vector<Finding>& all, report::Blanks& blanks) {
  for (const char* key : kFindings) blanks[key];
  for (const Finding& finding : all) blanks[finding.key] = beside(finding);
}

}  // namespace

std::string page_html(const Results& r) {
  const std::vector<Finding> all = findings(r);
  const SceneWords& words = scene_words(r.scene);
  std::string failures;
  for (const std::string& failure : r.failures) failures += "<p class=\"flag\">" + escape(failure) + "</p>\n";
  report::Blanks blanks{{"title", words.title},
                        {"lead", lead(all, words)},
                        {"such", words.such},
                        {"failures", failures},
                        {"findings", finding_table(all, words)},
                        {"convergence", convergence_table(r.convergence)},
                        {"difference", words.difference}};
  add_findings(all, blanks);
  for (const char* name : {"computed", "preload", "first_rates", "joint_figure"}) blanks[name];
  if (!r.design.contact.flank.empty()) {
    blanks["computed"] = "yes";
    blanks["preload"] = frequency_text(r) + " " + pressure_text(r);
    blanks["first_rates"] = first_rate_text(r);
    blanks["joint_figure"] = report::joint_figure(r.design, nullptr);
    for (const auto& [key, figure] : figures(r)) blanks[key] = report::figure_html(figure);
  }
  const std::string history =
      fmt::format("{} steps, {} steady states, {} Jacobians",
                  r.history.cycles.empty() ? 0 : r.history.cycles.size() - 1, r.history.solves, r.history.jacobians);
  return ready_study::page("The reference " + words.title + " \u2013 dovetail", texts::page_css, texts::page_html,
                           blanks, r.made, {{"History", history}});
}

}  // namespace dovetail::paper_sequence
