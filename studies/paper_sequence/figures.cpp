#include "studies/paper_sequence/figures.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "studies/paper_sequence/contact_figures.hpp"
#include "studies/paper_sequence/findings.hpp"
#include "studies/report/plots/report_plots.hpp"
#include "studies/report/words/units.hpp"

namespace dovetail::paper_sequence {
namespace {

using report::Plot;
using report::Role;
using report::scaled;
using report::Series;
using report::significant;
using report::Stroke;

/// Colours and strokes of lines that stand for a sequence or for nodes.
constexpr std::array<std::pair<Role, Stroke>, 6> kLooks{{{Role::after, Stroke::solid},
                                                         {Role::bad, Stroke::solid},
                                                         {Role::before, Stroke::solid},
                                                         {Role::after, Stroke::dashed},
                                                         {Role::bad, Stroke::dashed},
                                                         {Role::before, Stroke::dashed}}};

const report::PlotAxis kCycles{.label = "load cycles", .logarithmic = true, .tight = true};

Numbers relative_frequency(const Results& r) {
  return scaled(r.frequency_hz, r.resonance_hz);
}

/// Up to five nodes of the left flank, evenly over those that wear.
std::vector<std::size_t> shown_nodes(const Results& r) {
  std::vector<std::size_t> worn;
  if (r.history.depth_m.empty()) return worn;
  const Numbers& last = r.history.depth_m.back();
  const double deepest = largest_of(last).value;
  for (std::size_t i = 0; i < last.size(); ++i)
    if (r.design.contact.flank[i] == 0 && last[i] > 0.01 * deepest) worn.push_back(i);
  constexpr std::size_t kCurves = 5;
  if (worn.size() <= kCurves) return worn;
  std::vector<std::size_t> shown;
  for (std::size_t k = 0; k < kCurves; ++k) shown.push_back(worn[k * (worn.size() - 1) / (kCurves - 1)]);
  return shown;
}

/// Depths or rates of the shown nodes over cycles; the unworn state stands at half the cycles of the first step.
Plot courses(const Results& r, const std::vector<Numbers>& values, double si, Plot plot) {
  plot.x = kCycles;
  plot.y.from_zero = true;
  Numbers cycles = r.history.cycles;
  if (cycles.size() > 1) cycles.front() = 0.5 * cycles[1];
  const std::vector<std::size_t> nodes = shown_nodes(r);
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    const report::ContactRecord& contact = r.design.contact;
    Series line{.name = significant(contact.along_m[nodes[k]] / 1e-3, 2) +
                        (r.in_space() ? ", " + significant(contact.across_m[nodes[k]] / 1e-3, 2) : "") + " mm",
                .x = cycles,
                .role = kLooks[k].first,
                .stroke = kLooks[k].second};
    for (const Numbers& state : values) line.y.push_back(state[nodes[k]] / si);
    plot.series.push_back(std::move(line));
  }
  return plot;
}

std::string cycles_words(double cycles) {
  if (cycles == 0) return "new";
  return std::isfinite(cycles) ? significant(cycles, 2) + " cycles" : "at rest";
}

/// Cycles of the states on a logarithmic axis: the unworn one before, the asymptote after all others.
Numbers state_cycles(const Results& r) {
  Numbers cycles;
  for (const WornState& state : r.states)
    cycles.push_back(state.cycles == 0             ? 0.5 * (r.history.cycles.size() > 1 ? r.history.cycles[1] : 1)
                     : std::isfinite(state.cycles) ? state.cycles
                                                   : 2 * (r.history.cycles.empty() ? 1 : r.history.cycles.back()));
  return cycles;
}

/// A line for each state over the frequencies; of those between new and at rest the middle one is named.
std::vector<Series> state_lines(const Results& r, Numbers Curve::*quantity, double si) {
  std::vector<Series> lines;
  for (std::size_t i = 0; i < r.states.size(); ++i) {
    const bool first = i == 0, last = i + 1 == r.states.size();
    lines.push_back({.name = first || last || i == r.states.size() / 2 ? cycles_words(r.states[i].cycles) : "",
                     .x = relative_frequency(r),
                     .y = scaled(r.states[i].curve.*quantity, si),
                     .role = last    ? Role::after
                             : first ? Role::bad
                                     : Role::before});
  }
  return lines;
}

/// Over the frequencies of the study, from none.
Plot over_frequency(Plot plot, std::vector<Series> series) {
  plot.y.from_zero = true;
  plot.series = std::move(series);
  return plot;
}

Plot damping_figure(const Results& r) {
  std::vector<Series> series{{.name = "glued, without friction",
                              .x = relative_frequency(r),
                              .y = scaled(r.glued_amplitude_m, 1e-3),
                              .role = Role::before,
                              .stroke = Stroke::dashed}};
  if (!r.states.empty())
    series.push_back(
        {.name = "with friction", .x = relative_frequency(r), .y = scaled(r.states[0].curve.amplitude_m, 1e-3)});
  return over_frequency({.title = "Response with friction against glued flanks",
                         .description = "Amplitude of the aerofoil's tip; frequency over that of the unworn resonance.",
                         .x = {.label = "frequency / resonance"},
                         .y = {.label = "amplitude", .unit = "mm"}},
                        std::move(series));
}

Plot power_figure(const Results& r) {
  std::vector<Series> series;
  if (!r.states.empty()) series.push_back({.x = relative_frequency(r), .y = r.states.front().curve.power_w});
  return over_frequency({.title = "Power dissipated by friction",
                         .description = "Average over a period; of both flanks of one sector.",
                         .x = {.label = "frequency / resonance"},
                         .y = {.label = "power", .unit = "W"}},
                        std::move(series));
}

Plot depth_course_figure(const Results& r) {
  const std::string place = r.in_space() ? " and their place along the slot, from its middle" : "";
  return courses(r, r.history.depth_m, 1e-6,
                 {.title = "Wear depths over cycles",
                  .description = "Of some nodes of one flank, named by their distance from its neck side" + place + ".",
                  .y = {.label = "worn depth", .unit = "\u00b5m"}});
}

Plot rate_course_figure(const Results& r) {
  const double first = r.history.rate_m_per_cycle.empty() ? 1 : report::largest(r.history.rate_m_per_cycle.front());
  return courses(r, r.history.rate_m_per_cycle, first,
                 {.title = "Wear rates over cycles",
                  .description = "Of the same nodes, over the largest rate of the first cycle.",
                  .y = {.label = "rate / largest first rate"}});
}

Plot volume_figure(const Results& r) {
  Plot plot{.title = "Worn volume over cycles",
            .description = "Of both flanks; dashed: the state at rest, found directly.",
            .x = kCycles,
            .y = {.label = "worn volume", .unit = "mm\u00b3", .from_zero = true}};
  if (r.history.cycles.size() < 2) return plot;
  plot.series = {{.name = "history", .x = r.history.cycles, .y = scaled(r.history.volume_m3, 1e-9)},
                 {.name = "at rest",
                  .x = {r.history.cycles[1], r.history.cycles.back()},
                  .y = Numbers(2, r.asymptote_volume_m3 / 1e-9),
                  .role = Role::before,
                  .stroke = Stroke::dashed}};
  return plot;
}

Plot wearing_response_figure(const Results& r) {
  return over_frequency({.title = "Response as the joint wears",
                         .description = "From new to at rest, states by equal shares of the volume worn in the end.",
                         .x = {.label = "frequency / unworn resonance"},
                         .y = {.label = "amplitude", .unit = "mm"}},
                        state_lines(r, &Curve::amplitude_m, 1e-3));
}

Plot wearing_power_figure(const Results& r) {
  return over_frequency({.title = "Power dissipated as the joint wears",
                         .description = "Of the same states.",
                         .x = {.label = "frequency / unworn resonance"},
                         .y = {.label = "power", .unit = "W"}},
                        state_lines(r, &Curve::power_w, 1));
}

Plot amplitude_course_figure(const Results& r) {
  Plot plot{.title = "Amplitude while the joint wears",
            .description =
                "Excited at the unworn resonance, and at the resonance of the joint as worn then. First and "
                "last points: new, and at rest.",
            .x = kCycles,
            .y = {.label = "amplitude", .unit = "mm"}};
  Series held{.name = "at the unworn resonance", .x = r.history.cycles, .y = scaled(r.history.amplitude_m, 1e-3)};
  Series peak{.name = "at the resonance that moves",
              .x = state_cycles(r),
              .role = Role::bad,
              .stroke = Stroke::dashed,
              .mark = report::Mark::dot};
  for (const WornState& state : r.states) peak.y.push_back(state.peak_found ? state.peak_m / 1e-3 : std::nan(""));
  if (!r.states.empty() && !held.x.empty()) {
    held.x.front() = peak.x.front();
    held.x.push_back(peak.x.back());
    held.y.push_back(r.states.back().amplitude_m / 1e-3);
  }
  plot.series = {held, peak};
  return plot;
}

Plot drift_figure(const Results& r) {
  Plot plot{
      .title = "Resonance while the joint wears",
      .description = "Frequency of the peak over that of the unworn joint. First and last points: new, and at rest.",
      .x = kCycles,
      .y = {.label = "change of frequency", .unit = "10\u207b\u2074"}};
  Series line{.x = state_cycles(r), .mark = report::Mark::dot};
  for (const WornState& state : r.states)
    line.y.push_back(state.peak_found ? 1e4 * (state.peak_hz / r.resonance_hz - 1) : std::nan(""));
  plot.series.push_back(line);
  return plot;
}

}  // namespace

std::vector<std::pair<std::string, Figure>> figures(const Results& r) {
  return {{"nodal_diameters", report::nodal_diameter_plot(r.design)},
          {"preload_pressure", pressure_figure(r)},
          {"response", damping_figure(r)},
          {"dissipated_power", power_figure(r)},
          {"first_cycle_rates", first_rate_figure(r)},
          {"depths_over_cycles", depth_course_figure(r)},
          {"rates_over_cycles", rate_course_figure(r)},
          {"volume_over_cycles", volume_figure(r)},
          {"final_profiles", profile_figure(r)},
          {"responses_while_wearing", wearing_response_figure(r)},
          {"power_while_wearing", wearing_power_figure(r)},
          {"amplitude_while_wearing", amplitude_course_figure(r)},
          {"resonance_while_wearing", drift_figure(r)}};
}

}  // namespace dovetail::paper_sequence
