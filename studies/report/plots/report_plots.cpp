#include "studies/report/plots/report_plots.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>
#include <utility>

#include "studies/report/words/report_words.hpp"
#include "studies/report/words/units.hpp"

namespace dovetail::report {

namespace {

std::string name_of(const Comparison& designs, Role role, const std::string& variant) {
  const std::string design = designs.before ? (role == Role::before ? "before" : "after") : "";
  return design + (design.empty() || variant.empty() ? "" : ", ") + variant;
}

/// The designs with their roles, the older one first so that the newer is drawn on top.
std::vector<std::pair<const DesignRecord*, Role>> in_order(const Comparison& designs) {
  std::vector<std::pair<const DesignRecord*, Role>> result;
  if (designs.before) result.emplace_back(designs.before, Role::before);
  result.emplace_back(designs.after, Role::after);
  return result;
}

/// Two flanks that are mirror images to within half a per cent of the largest value.
bool flanks_alike(const ContactRecord& contact, const Numbers& values) {
  if (contact.flank_names.size() != 2) return false;
  std::array<Numbers, 2> sides, along;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const auto side = static_cast<std::size_t>(contact.flank[i] == 0 ? 0 : 1);
    sides[side].push_back(values[i]);
    along[side].push_back(contact.along_m[i]);
  }
  const auto near = [](const Numbers& a, const Numbers& b, double tolerance) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                      [&](double x, double y) { return std::abs(x - y) <= tolerance; });
  };
  return near(sides[0], sides[1], 0.005 * largest(values)) &&
         near(along[0], along[1], 0.001 * largest(contact.along_m));
}

/// A quantity of the contact nodes along both flanks, in space where along the slot it is largest: left solid, right
/// dashed.
Plot flank_plot(const Comparison& designs, Numbers ContactRecord::*quantity, std::string_view si_unit, Plot plot) {
  plot.x = kAlongFlank;
  for (const auto& [design, role] : in_order(designs)) {
    const ContactRecord& contact = design->contact;
    const Numbers& values = contact.*quantity;
    if (values.size() != contact.flank.size()) continue;
    const bool alike = flanks_alike(contact, values);
    for (std::size_t flank = 0; flank < (alike ? 1 : contact.flank_names.size()); ++flank)
      plot.series.push_back(
          along_line(contact.along_m, values,
                     worst_line(contact.flank, contact.across_m, values, static_cast<std::int64_t>(flank)),
                     {.name = name_of(designs, role, alike ? "both flanks" : contact.flank_names[flank]),
                      .role = role,
                      .stroke = flank == 0 ? Stroke::solid : Stroke::dashed}));
  }
  return readable(std::move(plot), si_unit);
}

Plot fillet_plot(const Comparison& designs) {
  Plot plot{.title = "Stress in the fillets",
            .description =
                "Largest von Mises stress over one period of the resonance, along the more loaded fillet of the "
                "blade's neck (solid) and of the disk's slot (dashed).",
            .x = {.label = "height above the fillet's lower end", .unit = "mm"},
            .y = {.label = "von Mises stress", .unit = "MPa", .from_zero = true}};
  for (const auto& [design, role] : in_order(designs)) {
    for (const FilletRecord& fillet : design->fillets) {
      const std::size_t count = fillet.von_mises_pa.size();
      if (count == 0 || fillet.x_m.size() != count || fillet.y_m.size() != count) continue;
      const auto peak = static_cast<std::size_t>(
          std::max_element(fillet.von_mises_pa.begin(), fillet.von_mises_pa.end()) - fillet.von_mises_pa.begin());
      std::vector<std::pair<double, double>> points;  // height, stress
      for (std::size_t i = 0; i < count; ++i)
        if ((fillet.x_m[i] > 0) == (fillet.x_m[peak] > 0)) points.emplace_back(fillet.y_m[i], fillet.von_mises_pa[i]);
      std::sort(points.begin(), points.end());
      // In space nodes of one height stand side by side along the slot: the most loaded of them tells.
      constexpr double kSameHeight = 1e-7;
      for (std::size_t i = points.size(); i-- > 1;)
        if (points[i].first - points[i - 1].first < kSameHeight) {
          points[i - 1].second = std::max(points[i - 1].second, points[i].second);
          points.erase(points.begin() + static_cast<std::ptrdiff_t>(i));
        }
      Series series{.name = name_of(designs, role, fillet.name),
                    .role = role,
                    .stroke = fillet.name == "blade" ? Stroke::solid : Stroke::dashed};
      for (const auto& [height, stress] : points) series.add((height - points.front().first) / 1e-3, stress / 1e6);
      plot.series.push_back(std::move(series));
    }
  }
  return plot;
}

}  // namespace

std::vector<FlankPanel> flank_panels(const ContactRecord& contact, const Numbers& values) {
  std::vector<FlankPanel> panels;
  for (std::size_t f = 0; f < contact.flank_names.size(); ++f) {
    FlankPanel& panel = panels.emplace_back();
    panel.name = contact.flank_names[f] + " flank";
    for (std::size_t i = 0; i < values.size(); ++i) {
      if (contact.flank[i] != static_cast<std::int64_t>(f)) continue;
      panel.along.push_back(contact.along_m[i]);
      panel.across.push_back(contact.across_m[i]);
      panel.values.push_back(values[i]);
    }
  }
  return panels;
}

bool in_space(const ContactRecord& contact) {
  const auto [least, most] = std::minmax_element(contact.across_m.begin(), contact.across_m.end());
  return least != contact.across_m.end() && *most > *least;
}

namespace {

/// "Largest: 3.5 µm, on the left flank, 0.5 mm from its neck side, -7.5 mm along the slot from its middle."
std::string largest_place(const FlankMap& map) {
  double most = 0;
  std::string place;
  for (const FlankPanel& panel : map.panels)
    for (std::size_t i = 0; i < panel.values.size(); ++i)
      if (std::isfinite(panel.values[i]) && panel.values[i] > most * (1 + 1e-6)) {
        most = panel.values[i];
        place = fmt::format("on the {}, {}\u00a0mm from its neck side, {}\u00a0mm along the slot from its middle",
                            panel.name, significant(panel.along[i] / 1e-3, 3), plain(panel.across[i] / 1e-3, 3));
      }
  return place.empty()
             ? ""
             : fmt::format(" Largest: {}\u00a0{}, {}.", significant(most / map.unit.si, 3), map.unit.symbol, place);
}

}  // namespace

std::vector<Figure> contact_maps(const Comparison& designs) {
  std::vector<Figure> maps;
  const auto add = [&](Numbers ContactRecord::*quantity, const char* si_unit, const FlankMap& look) {
    double most = 0;
    for (const auto& [design, role] : in_order(designs)) most = std::max(most, largest(design->contact.*quantity));
    for (const auto& [design, role] : in_order(designs)) {
      if (!in_space(design->contact) || (design->contact.*quantity).empty()) continue;
      FlankMap map = look;
      if (designs.before) map.title += role == Role::before ? ", before" : ", after";
      map.unit = readable_unit(si_unit, most);
      map.panels = flank_panels(design->contact, design->contact.*quantity);
      map.full_scale = most;
      map.description += largest_place(map);
      maps.emplace_back(std::move(map));
    }
  };
  add(&ContactRecord::depth_m, "m",
      {.title = "Wear depth over the flanks",
       .description = "When wear has come to rest; worn off both surfaces together.",
       .quantity = "worn depth",
       .at_zero = "Nothing wears: the depth is zero everywhere."});
  add(&ContactRecord::preload_pressure_pa, "Pa",
      {.title = "Pressure over the flanks after spin-up",
       .description = "Under the centrifugal load alone, before any vibration.",
       .quantity = "pressure"});
  add(&ContactRecord::slip_m_per_cycle, "m",
      {.title = "Slip over the flanks",
       .description = "Path that slips under load in one cycle of the unworn resonance.",
       .quantity = "slip per cycle",
       .at_zero = "Nothing slips: both flanks stick everywhere."});
  return maps;
}

double largest(const Numbers& values) {
  double result = 0;
  for (const double value : values)
    if (std::isfinite(value)) result = std::max(result, std::abs(value));
  return result;
}

Numbers scaled(const Numbers& values, double si) {
  Numbers result = values;
  for (double& value : result) value /= si;
  return result;
}

Plot readable(Plot plot, std::string_view si_unit) {
  double most = 0;
  for (const Series& series : plot.series) most = std::max(most, largest(series.y));
  const Unit unit = readable_unit(si_unit, most);
  for (Series& series : plot.series) series.y = scaled(series.y, unit.si);
  plot.y.unit = unit.symbol;
  plot.y.from_zero = true;
  return plot;
}

Series along_line(const Numbers& along_m, const Numbers& values, const std::vector<std::size_t>& nodes, Series look) {
  for (const std::size_t i : nodes) look.add(along_m[i] / 1e-3, values[i]);
  return look;
}

std::vector<Figure> contact_plots(const Comparison& designs) {
  std::vector<Figure> plots{
      flank_plot(designs, &ContactRecord::depth_m, "m",
                 {.title = "Wear depth when wear has come to rest",
                  .description = "Depth worn off both surfaces together. Where it is zero, the surfaces stick or "
                                 "do not touch.",
                  .y = {.label = "worn depth"},
                  .at_zero = "Nothing wears: the depth is zero everywhere."}),
      flank_plot(designs, &ContactRecord::preload_pressure_pa, "Pa",
                 {.title = "Pressure after spin-up",
                  .description = "Contact pressure under the centrifugal load alone, before any vibration.",
                  .y = {.label = "pressure"}}),
      flank_plot(designs, &ContactRecord::gap_m, "m",
                 {.title = "Form of the flanks",
                  .description = "Gap between blade and disk before loading: mismatch, crown, relief and rounded "
                                 "ends together.",
                  .y = {.label = "gap"},
                  .at_zero = "Both flanks are flat and parallel: the gap is zero everywhere."}),
      fillet_plot(designs)};
  if (designs.after && optimizer::converged(designs.after->status))
    std::erase_if(plots, [](const Figure& figure) {
      const Plot& plot = std::get<Plot>(figure);
      return plot.series.empty() && is_empty(plot);
    });
  return plots;
}

Plot response_plot(const Comparison& designs) {
  Plot plot{.title = "Response around the resonance",
            .description =
                "Amplitude of the aerofoil's tip. Solid: new joint; dashed: worn joint; dotted: the same "
                "blade glued to the disk, without friction.",
            .x = {.label = "frequency", .unit = "Hz"},
            .y = {.label = "amplitude"}};
  for (const auto& [design, role] : in_order(designs))
    for (const auto& [curve, name, stroke] : {std::tuple{&design->glued, "glued", Stroke::dotted},
                                              {&design->unworn, "new", Stroke::solid},
                                              {&design->worn, "worn", Stroke::dashed}})
      if (!curve->frequency_hz.empty())
        plot.series.push_back({.name = name_of(designs, role, name),
                               .x = curve->frequency_hz,
                               .y = curve->amplitude_m,
                               .role = role,
                               .stroke = stroke});
  return readable(std::move(plot), "m");
}

}  // namespace dovetail::report
