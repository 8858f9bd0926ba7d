// Natural frequencies over nodal diameters, and the engine orders that meet them.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "studies/report/plots/report_plots.hpp"

namespace dovetail::report {

Plot nodal_diameter_plot(const DesignRecord& design) {
  const NodalDiameterRecord& record = design.nodal_diameters;
  Plot plot{.title = "Natural frequencies of the glued bladed disk",
            .description = "At speed, over the number of nodal diameters; flat stretches are blade modes.",
            .x = {.label = "nodal diameters", .whole = true},
            .y = {.label = "frequency", .unit = "Hz", .from_zero = true}};
  const auto modes = static_cast<std::size_t>(std::max<std::int64_t>(record.modes, 0));
  if (record.frequency_hz.size() != modes * record.nodal_diameter.size()) return plot;
  for (std::size_t mode = 0; mode < modes; ++mode) {
    Series series{.mark = Mark::dot};
    for (std::size_t d = 0; d < record.nodal_diameter.size(); ++d)
      series.add(static_cast<double>(record.nodal_diameter[d]), optimizer::converged(record.status[d])
                                                                    ? record.frequency_hz[d * modes + mode]
                                                                    : std::numeric_limits<double>::quiet_NaN());
    plot.series.push_back(std::move(series));
  }
  return plot;
}

namespace {

/// The resonance in the middle, as many of its per cent to both sides as the nearest engine order needs to be seen, and
/// 3 at least: then flat blade modes and what veers off them are told apart. On round numbers.
Bounds around_resonance(double mode, double turns) {
  constexpr double kLeast = 0.03, kBeyondOrder = 1.3;
  const double nearest = turns * std::max(1.0, std::round(mode / turns));
  const double half = std::max(kLeast * mode, kBeyondOrder * std::abs(nearest - mode));
  const double step = std::pow(10.0, std::floor(std::log10(half)));
  return {.lower = std::max(0.0, step * std::floor((mode - half) / step)),
          .upper = step * std::ceil((mode + half) / step)};
}

}  // namespace

Plot engine_order_plot(const DesignRecord& design) {
  Plot plot{.title = "Engine orders around the resonance",
            .description =
                "The same frequencies near the mode under study. A multiple of the speed of rotation, an "
                "engine order, excites the one nodal diameter it comes to on so many blades; where its mark "
                "meets a line there is a resonance at speed.",
            .x = {.label = "nodal diameters", .whole = true},
            .y = {.label = "frequency", .unit = "Hz"}};
  const auto number = [&](const std::map<std::string, double>& of, const char* name) {
    const auto found = of.find(name);
    return found != of.end() && found->second > 0 ? found->second : std::nan("");
  };
  const double turns = number(design.parameters, "scene.speed_rpm") / 60,
               mode = number(design.responses, "resonance_hz");
  const auto blades = static_cast<long>(number(design.parameters, "geometry.sectors"));
  if (!std::isfinite(turns) || !std::isfinite(mode) || blades < 2) return plot;
  const Bounds range = around_resonance(mode, turns);
  plot.y.range = range;
  const auto seen = [&range](double y) { return y >= range.lower && y <= range.upper; };
  std::size_t number_of_mode = 0;
  for (Series& series : nodal_diameter_plot(design).series) {
    ++number_of_mode;
    if (std::ranges::none_of(series.y, seen)) continue;
    series.name = fmt::format("mode {}", number_of_mode);
    series.role = plot.series.empty() ? Role::after : Role::before;
    plot.series.push_back(std::move(series));
  }
  if (plot.series.empty()) return plot;
  Series orders{.name = "engine orders", .role = Role::bad, .stroke = Stroke::none, .mark = Mark::cross};
  for (long order = std::max(1L, std::lround(std::ceil(range.lower / turns)));
       static_cast<double>(order) * turns <= range.upper; ++order) {
    const long folded = order % blades;
    orders.add(static_cast<double>(std::min(folded, blades - folded)), static_cast<double>(order) * turns);
    orders.labels.push_back(fmt::format("EO {}", order));
  }
  plot.series.push_back(std::move(orders));
  const auto most = blades / 2;
  plot.series.push_back({.name = "resonance of the joint",
                         .x = {0, static_cast<double>(most)},
                         .y = {mode, mode},
                         .role = Role::muted,
                         .stroke = Stroke::dashed});
  return plot;
}

}  // namespace dovetail::report
