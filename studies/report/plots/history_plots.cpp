// Plots of the wear history, and of histories beside the direct method.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "studies/report/plots/report_plots.hpp"
#include "studies/report/words/units.hpp"

namespace dovetail::report {

namespace {

/// Cycles of a history on a logarithmic axis, without the unworn state at zero; steps grow by orders of magnitude as
/// wear comes to rest.
const PlotAxis kCycles{.label = "load cycles", .logarithmic = true};

/// The designs of a comparison that have a history, with their names, the older one first.
std::vector<std::tuple<const DesignRecord*, std::string, Role>> histories(const Comparison& designs) {
  std::vector<std::tuple<const DesignRecord*, std::string, Role>> found;
  if (designs.before && designs.before->history) found.emplace_back(designs.before, "before", Role::before);
  if (designs.after->history) found.emplace_back(designs.after, designs.before ? "after" : "", Role::after);
  return found;
}

/// The values over the cycles, SI.
Plot history_lines(const Comparison& designs, Numbers HistoryRecord::*quantity, Plot plot) {
  plot.x = kCycles;
  for (const auto& [design, name, role] : histories(designs))
    plot.series.push_back({.name = name,
                           .x = design->history->cycles,
                           .y = (*design->history).*quantity,
                           .role = role,
                           .mark = Mark::dot});
  return plot;
}

Plot volume_plot(const Comparison& designs) {
  Plot plot =
      history_lines(designs, &HistoryRecord::worn_volume_m3,
                    {.title = "Wear over load cycles",
                     .description = "Worn volume by jumps over many cycles; dashed: the limit computed directly, "
                                    "dotted: its error bar.",
                     .y = {.label = "worn volume"},
                     .at_zero = "Nothing wears: the worn volume stays zero."});
  for (const auto& [design, name, role] : histories(designs)) {
    const auto limit = design->responses.find("asymptotic_wear_volume_m3");
    const Numbers& cycles = design->history->cycles;
    if (limit == design->responses.end() || cycles.size() < 2) continue;
    const auto level = [&, whose = name, look = role](const std::string& what, double value, Stroke stroke) {
      plot.series.push_back({.name = whose.empty() || what.empty() ? what : whose + ", " + what,
                             .x = {cycles[1], cycles.back()},
                             .y = Numbers(2, value),
                             .role = look,
                             .stroke = stroke});
    };
    level("asymptote", limit->second, Stroke::dashed);
    const auto error = design->error_estimates.find("asymptotic_wear_volume_m3");
    if (error == design->error_estimates.end() || !std::isfinite(error->second) || !(error->second > 0)) continue;
    level("its error bar", limit->second + error->second, Stroke::dotted);
    level("", std::max(limit->second - error->second, 0.0), Stroke::dotted);
  }
  return readable(std::move(plot), "m^3");
}

/// The nodes along the flank that wears most, in space where it is deepest.
std::vector<std::size_t> most_worn_line(const std::vector<std::int64_t>& flanks, const Numbers& across,
                                        const Numbers& depth, std::size_t flank_count) {
  Numbers worn(flank_count + 1, 0.0);
  for (std::size_t i = 0; i < flanks.size(); ++i) worn[static_cast<std::size_t>(flanks[i])] += depth[i];
  return worst_line(flanks, across, depth, std::max_element(worn.begin(), worn.end()) - worn.begin());
}

Plot profile_plot(const DesignRecord& design, const std::string& name) {
  Plot plot{.title = "Worn profile while the joint wears" + (name.empty() ? "" : ", " + name),
            .description = "Depth along the more worn flank at some of the states of the history, from new to last.",
            .x = kAlongFlank,
            .y = {.label = "worn depth"},
            .at_zero = "Nothing wears: the depth stays zero."};
  const ContactRecord& contact = design.contact;
  const std::size_t count = contact.flank.size();
  if (!design.history || count == 0) return plot;
  const HistoryRecord& history = *design.history;
  const std::size_t profiles = history.profile_states.size();
  if (profiles == 0 || history.profile_depth_m.size() != profiles * count) return plot;
  const auto profile = [&](std::size_t p) {
    const auto begin = history.profile_depth_m.begin() + static_cast<std::ptrdiff_t>(p * count);
    return Numbers(begin, begin + static_cast<std::ptrdiff_t>(count));
  };
  const std::vector<std::size_t> line =
      most_worn_line(contact.flank, contact.across_m, profile(profiles - 1), contact.flank_names.size());
  for (std::size_t p = 0; p < profiles; ++p) {
    const auto state = static_cast<std::size_t>(std::max<std::int64_t>(history.profile_states[p], 0));
    const double cycles = state < history.cycles.size() ? history.cycles[state] : 0;
    Series series = along_line(contact.along_m, profile(p), line, {.name = significant(cycles, 2) + " cycles"});
    series.shade = static_cast<double>(p) / static_cast<double>(std::max<std::size_t>(profiles - 1, 1));
    if (largest(series.y) > 0 || p + 1 == profiles) plot.series.push_back(std::move(series));
  }
  return readable(std::move(plot), "m");
}

}  // namespace

std::vector<Figure> history_plots(const Comparison& designs) {
  std::vector<Figure> plots{
      volume_plot(designs),
      readable(history_lines(designs, &HistoryRecord::depth_max_m,
                             {.title = "Largest depth over load cycles",
                              .description = "Of the contact nodes, both surfaces together.",
                              .y = {.label = "largest worn depth"},
                              .at_zero = "Nothing wears: the depth stays zero."}),
               "m"),
      readable(history_lines(designs, &HistoryRecord::amplitude_m,
                             {.title = "Amplitude while the joint wears",
                              .description = "Of the aerofoil's tip, at the exciting frequency of the history.",
                              .y = {.label = "amplitude"}}),
               "m")};
  for (const auto& [design, name, role] : histories(designs)) plots.emplace_back(profile_plot(*design, name));
  return plots;
}

Plot verification_plot(const VerificationRecord& record) {
  Plot plot{.title = fmt::format("Worn profile of evaluation {}", record.evaluation + 1),
            .description =
                "Depth along the more worn flank. Solid: the end of the history; dashed: the direct method "
                "at the same settings; dotted: at finer ones, read at the same contact nodes.",
            .x = kAlongFlank,
            .y = {.label = "worn depth", .from_zero = true}};
  const std::size_t count = record.flank.size();
  if (count == 0 || record.search_profile_m.size() != count) return plot;
  Numbers deepest(count, 0);
  for (const Numbers* profile : {&record.history_profile_m, &record.search_profile_m, &record.direct_profile_m})
    for (std::size_t i = 0; i < std::min(count, profile->size()); ++i) deepest[i] = std::max(deepest[i], (*profile)[i]);
  const std::vector<std::size_t> line =
      most_worn_line(record.flank, record.across_m, deepest, record.flank_names.size());
  const auto add = [&](const char* name, const Numbers& profile, Role role, Stroke stroke) {
    if (profile.size() == count)
      plot.series.push_back(along_line(record.along_m, profile, line, {.name = name, .role = role, .stroke = stroke}));
  };
  add("history", record.history_profile_m, Role::after, Stroke::solid);
  add("direct", record.search_profile_m, Role::before, Stroke::dashed);
  add("finer", record.direct_profile_m, Role::muted, Stroke::dotted);
  return readable(std::move(plot), "m");
}

}  // namespace dovetail::report
