#include "studies/report/flank_map.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "studies/report/html.hpp"
#include "studies/report/ticks.hpp"

namespace dovetail::report {

namespace {

constexpr double kMillimetre = 1e-3;
constexpr int kWidth = 520;
constexpr double kLeft = 46, kTop = 24, kGap = 34, kBarGap = 22, kBarWidth = 12, kRight = 52, kBottom = 40;

/// Colours from nothing to the largest value, light to dark, of even steps in lightness; readable on light and dark
/// paper.
std::string colour(double share) {
  constexpr std::array<std::array<double, 3>, 6> kStops{
      {{253, 246, 218}, {252, 207, 130}, {243, 146, 84}, {214, 84, 86}, {146, 43, 98}, {62, 19, 75}}};
  const double at = std::clamp(share, 0.0, 1.0) * (kStops.size() - 1);
  const std::size_t below = std::min(static_cast<std::size_t>(at), kStops.size() - 2);
  const double t = at - static_cast<double>(below);
  std::array<int, 3> rgb{};
  for (std::size_t c = 0; c < 3; ++c)
    rgb[c] = static_cast<int>(std::lround((1 - t) * kStops[below][c] + t * kStops[below + 1][c]));
  return fmt::format("#{:02x}{:02x}{:02x}", rgb[0], rgb[1], rgb[2]);
}

std::vector<double> distinct(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const double close = values.empty() ? 0 : 1e-6 * (values.back() - values.front()) + 1e-12;
  std::vector<double> kept;
  for (const double v : values)
    if (kept.empty() || v - kept.back() > close) kept.push_back(v);
  return kept;
}

/// Ends of the cell around a grid line: half-way to its neighbours, the line itself at the border.
std::array<double, 2> cell(const std::vector<double>& lines, double value) {
  const auto at = std::lower_bound(lines.begin(), lines.end(), value - 1e-12 - 1e-6 * (lines.back() - lines.front()));
  const auto i = static_cast<std::size_t>(at - lines.begin());
  return {i == 0 ? lines.front() : (lines[i - 1] + lines[i]) / 2,
          i + 1 >= lines.size() ? lines.back() : (lines[i] + lines[i + 1]) / 2};
}

double largest_value(const FlankMap& map) {
  double most = map.full_scale;
  for (const FlankPanel& panel : map.panels)
    for (const double v : panel.values)
      if (std::isfinite(v)) most = std::max(most, v);
  return most;
}

/// A linear map from millimetres to pixels.
struct Axis {
  double lower, upper, from, to;
  [[nodiscard]] double operator()(double mm) const { return from + (to - from) * (mm - lower) / (upper - lower); }
};

Axis axis_of(const std::vector<double>& lines, double from, double to) {
  const double lower = lines.front() / kMillimetre, upper = lines.back() / kMillimetre;
  const double widen = upper > lower ? 0 : 0.5;
  return {lower - widen, upper + widen, from, to};
}

std::string cells(const FlankPanel& panel, const FlankMap& map, double most, const Axis& x, const Axis& y) {
  const std::vector<double> along = distinct(panel.along), across = distinct(panel.across);
  std::string text = "<g shape-rendering=\"crispEdges\">";
  for (std::size_t i = 0; i < panel.values.size(); ++i) {
    const auto [x0, x1] = cell(across, panel.across[i]);
    const auto [y0, y1] = cell(along, panel.along[i]);
    const double v = panel.values[i];
    text += fmt::format(
        "<rect x=\"{:.2f}\" y=\"{:.2f}\" width=\"{:.2f}\" height=\"{:.2f}\" fill=\"{}\"><title>{} mm, {} mm: {} {}"
        "</title></rect>",
        x(x0 / kMillimetre), y(y0 / kMillimetre), x(x1 / kMillimetre) - x(x0 / kMillimetre),
        y(y1 / kMillimetre) - y(y0 / kMillimetre), std::isfinite(v) ? colour(v / most) : "var(--hair)",
        significant(panel.across[i] / kMillimetre, 3), significant(panel.along[i] / kMillimetre, 3),
        significant(v / map.unit.si, 4), escape(map.unit.symbol));
  }
  return text + "</g>\n";
}

std::string frame(const Axis& x, const Axis& y, const std::string& name, bool first) {
  std::string text = fmt::format(
      "<rect x=\"{:.2f}\" y=\"{:.2f}\" width=\"{:.2f}\" height=\"{:.2f}\" fill=\"none\" stroke=\"var(--base)\"/>"
      "<text class=\"title\" x=\"{:.2f}\" y=\"{:.2f}\">{}</text>",
      x.from, y.from, x.to - x.from, y.to - y.from, x.from, y.from - 8, escape(name));
  text += "<g class=\"grid\">";
  const Ticks across = linear_ticks(x.lower, x.upper, 3, true), along = linear_ticks(y.lower, y.upper, 4, true);
  for (std::size_t k = 0; k < across.at.size(); ++k)
    text += fmt::format("<text class=\"x\" x=\"{:.2f}\" y=\"{:.2f}\">{}</text>", x(across.at[k]), y.to + 16,
                        across.labels[k]);
  if (first)
    for (std::size_t k = 0; k < along.at.size(); ++k)
      text += fmt::format("<text class=\"y\" x=\"{:.2f}\" y=\"{:.2f}\">{}</text>", x.from - 6, y(along.at[k]) + 4,
                          along.labels[k]);
  return text + "</g>\n";
}

std::string colour_bar(const FlankMap& map, double most, double left, double top, double bottom) {
  std::string text;
  constexpr int kSteps = 48;
  const double height = (bottom - top) / kSteps;
  for (int k = 0; k < kSteps; ++k)
    text += fmt::format(
        "<rect x=\"{:.2f}\" y=\"{:.2f}\" width=\"{:.2f}\" height=\"{:.2f}\" fill=\"{}\" "
        "shape-rendering=\"crispEdges\"/>",
        left, bottom - (k + 1) * height, kBarWidth, height + 0.5, colour((k + 0.5) / kSteps));
  const Ticks ticks = linear_ticks(0, most / map.unit.si, 4, true);
  for (std::size_t k = 0; k < ticks.at.size(); ++k)
    text += fmt::format("<text x=\"{:.2f}\" y=\"{:.2f}\">{}</text>", left + kBarWidth + 5,
                        bottom - (bottom - top) * ticks.at[k] * map.unit.si / most + 4, ticks.labels[k]);
  return text + fmt::format("<text class=\"title\" x=\"{}\" y=\"{:.2f}\" text-anchor=\"end\">{}</text>\n", kWidth,
                            top - 8, escape(map.unit.symbol));
}

std::string numbers(const FlankMap& map) {
  const std::string unit = map.unit.symbol.empty() ? "" : " (" + map.unit.symbol + ")";
  std::string text =
      "<table><thead><tr><th>flank</th><th>along the slot (mm)</th><th>from the neck side (mm)</th><th>" +
      escape(map.quantity + unit) + "</th></tr></thead><tbody>\n";
  for (const FlankPanel& panel : map.panels)
    for (std::size_t i = 0; i < panel.values.size(); ++i)
      text += fmt::format("<tr><td>{}</td><td>{}</td><td>{}</td><td>{}</td></tr>\n", escape(panel.name),
                          plain(panel.across[i] / kMillimetre, 5), plain(panel.along[i] / kMillimetre, 5),
                          significant(panel.values[i] / map.unit.si, 5));
  return "<details class=\"numbers\"><summary>Numbers</summary><div class=\"scroll\">" + text +
         "</tbody></table>\n</div></details>\n";
}

}  // namespace

bool is_empty(const FlankMap& map) {
  return std::none_of(map.panels.begin(), map.panels.end(), [](const FlankPanel& panel) {
    return std::any_of(panel.values.begin(), panel.values.end(), [](double v) { return std::isfinite(v) && v > 0; });
  });
}

std::string flank_map_svg(const FlankMap& map) {
  const double most = largest_value(map);
  const auto count = static_cast<double>(std::max<std::size_t>(map.panels.size(), 1));
  const double width = (kWidth - kLeft - kRight - kBarGap - kBarWidth - (count - 1) * kGap) / count;
  constexpr double kHeight = 190;
  std::string text = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" class=\"plot\" viewBox=\"0 0 {} {}\" role=\"img\" "
      "aria-label=\"{}\">\n",
      kWidth, kTop + kHeight + kBottom, escape(map.title));
  for (std::size_t p = 0; p < map.panels.size(); ++p) {
    const FlankPanel& panel = map.panels[p];
    if (panel.values.empty()) continue;
    const double left = kLeft + static_cast<double>(p) * (width + kGap);
    const Axis x = axis_of(distinct(panel.across), left, left + width);
    const Axis y = axis_of(distinct(panel.along), kTop, kTop + kHeight);
    text += cells(panel, map, most, x, y) + frame(x, y, panel.name, p == 0);
  }
  text += fmt::format(
      "<text class=\"title\" x=\"{:.2f}\" y=\"{:.2f}\" text-anchor=\"middle\">along the slot, mm</text>"
      "<text class=\"title\" transform=\"translate(12 {:.2f}) rotate(-90)\" text-anchor=\"middle\">from the neck side, "
      "mm</text>\n",
      kLeft + (count * width + (count - 1) * kGap) / 2, kTop + kHeight + 34, kTop + kHeight / 2);
  return text + colour_bar(map, most, kWidth - kRight - kBarWidth, kTop, kTop + kHeight) + "</svg>\n";
}

std::string flank_map_figure(const FlankMap& map) {
  const std::string title = "<h3>" + escape(map.title) + "</h3>\n";
  if (is_empty(map))
    return "<figure class=\"nothing\">" + title + "<p>Nothing to show: no value above zero.</p></figure>\n";
  std::string text = "<figure>" + title + flank_map_svg(map);
  if (!map.description.empty()) text += "<figcaption>" + escape(map.description) + "</figcaption>\n";
  return text + numbers(map) + "</figure>\n";
}

}  // namespace dovetail::report
