// Plots of the wear history.
#include <algorithm>
#include <cmath>
#include <utility>

#include "studies/report/pages/units.hpp"
#include "studies/report/plots/report_plots.hpp"

namespace dovetail::report {

namespace {

/// Cycles of a history on a logarithmic axis, without the unworn state at zero; steps grow by orders of magnitude as
/// wear comes to rest.
PlotAxis cycle_axis() {
  return {.label = "load cycles", .logarithmic = true};
}

Plot history_line(const DesignRecord& design, Numbers HistoryRecord::*quantity, const std::string& si_unit, Plot plot) {
  plot.x = cycle_axis();
  if (!design.history) return plot;
  const Numbers& values = (*design.history).*quantity;
  const Unit unit = readable_unit(si_unit, largest(values));
  plot.y.unit = unit.symbol;
  plot.y.from_zero = true;
  PlotLine line{.x = design.history->cycles, .y = scaled(values, unit.si)};
  line.dots = true;
  plot.lines.push_back(std::move(line));
  return plot;
}

}  // namespace

Plot history_plot(const DesignRecord& design) {
  Plot plot =
      history_line(design, &HistoryRecord::worn_volume_m3, "m^3",
                   {.title = "Wear over load cycles",
                    .description = "Worn volume by jumps over many cycles; dashed: the limit computed directly, "
                                   "dotted: its error bar.",
                    .y = {.label = "worn volume"}});
  const auto limit = design.responses.find("asymptotic_wear_volume_m3");
  if (!design.history || limit == design.responses.end() || design.history->cycles.size() < 2) return plot;
  plot.lines.front().name = "history";
  const double si = readable_unit("m^3", largest(design.history->worn_volume_m3)).si;
  const Numbers ends{design.history->cycles[1], design.history->cycles.back()};
  const auto level = [&](const std::string& name, double value, Stroke stroke) {
    plot.lines.push_back({.name = name, .x = ends, .y = Numbers(2, value / si), .role = Role::muted, .stroke = stroke});
  };
  level("asymptote", limit->second, Stroke::dashed);
  const auto error = design.error_estimates.find("asymptotic_wear_volume_m3");
  if (error == design.error_estimates.end() || !std::isfinite(error->second) || !(error->second > 0)) return plot;
  level("its error bar", limit->second + error->second, Stroke::dotted);
  level("", std::max(limit->second - error->second, 0.0), Stroke::dotted);
  return plot;
}

Plot history_depth_plot(const DesignRecord& design) {
  return history_line(design, &HistoryRecord::depth_max_m, "m",
                      {.title = "Largest depth over load cycles",
                       .description = "Of the contact nodes, both surfaces together.",
                       .y = {.label = "largest worn depth"}});
}

Plot history_amplitude_plot(const DesignRecord& design) {
  return history_line(design, &HistoryRecord::amplitude_m, "m",
                      {.title = "Amplitude while the joint wears",
                       .description = "Of the aerofoil's tip, at the exciting frequency of the history.",
                       .y = {.label = "amplitude"}});
}

Plot history_profile_plot(const DesignRecord& design) {
  Plot plot{
      .title = "Worn profile while the joint wears",
      .description = "Depth along the more worn flank at some of the states of the history, from new to last.",
      .x = {.label = "along the flank, from its neck side", .unit = "mm"},
  };
  const ContactRecord& contact = design.contact;
  const std::size_t count = contact.flank.size();
  if (!design.history || count == 0) return plot;
  const HistoryRecord& history = *design.history;
  const std::size_t profiles = history.profile_states.size();
  if (profiles == 0 || history.profile_depth_m.size() != profiles * count) return plot;
  std::vector<double> worn(contact.flank_names.size() + 1, 0.0);
  for (std::size_t i = 0; i < count; ++i) {
    const auto flank = static_cast<std::size_t>(
        std::clamp<std::int64_t>(contact.flank[i], 0, static_cast<std::int64_t>(contact.flank_names.size())));
    worn[flank] += history.profile_depth_m[(profiles - 1) * count + i];
  }
  const auto shown = std::max_element(worn.begin(), worn.end()) - worn.begin();
  const Numbers last_profile(history.profile_depth_m.end() - static_cast<std::ptrdiff_t>(count),
                             history.profile_depth_m.end());
  const Unit unit = readable_unit("m", largest(history.profile_depth_m));
  plot.y = {
      .label = "worn depth",
      .unit = unit.symbol,
      .from_zero = true,
  };
  for (std::size_t p = 0; p < profiles; ++p) {
    const auto state = static_cast<std::size_t>(std::max<std::int64_t>(history.profile_states[p], 0));
    const double cycles = state < history.cycles.size() ? history.cycles[state] : 0;
    const bool last = p + 1 == profiles;
    PlotLine line{.name = significant(cycles, 2) + " cycles", .role = last ? Role::after : Role::before};
    line.stroke = last || p % 2 == 0 ? Stroke::solid : Stroke::dashed;
    for (const std::size_t i : worst_line(contact.flank, contact.across_m, last_profile, shown)) {
      line.x.push_back(contact.along_m[i] / 1e-3);
      line.y.push_back(history.profile_depth_m[p * count + i] / unit.si);
    }
    if (largest(line.y) > 0) plot.lines.push_back(std::move(line));
  }
  return plot;
}

}  // namespace dovetail::report
