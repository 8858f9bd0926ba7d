#include "studies/report/plots/flank_map.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

#include "studies/report/plots/scale.hpp"
#include "studies/report/words/html.hpp"

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

/// Ends of cells around rising places: half-way between neighbours, the outermost places in the middle of their cells.
std::vector<double> ends_around(const std::vector<double>& places) {
  if (places.size() < 2) return {places.front(), places.front()};
  std::vector<double> ends{0};
  for (std::size_t k = 0; k + 1 < places.size(); ++k) ends.push_back((places[k] + places[k + 1]) / 2);
  ends.front() = 2 * places.front() - ends[1];
  ends.push_back(2 * places.back() - ends.back());
  return ends;
}

/// Ends of cells that follow one another from the edge of the flank on, each around its place; half-way between places
/// that are not in the middle of such cells.
std::vector<double> ends_from_edge(const std::vector<double>& places) {
  std::vector<double> ends{0};
  for (const double place : places) {
    ends.push_back(2 * place - ends.back());
    if (ends.back() <= place) return ends_around(places);
  }
  return ends;
}

/// A panel as rectangles: strips of nodes across the slot, each with cells of its own, as contact nodes end where worn
/// zones do.
struct Rectangles {
  std::vector<double> across;                          ///< ends of the strips
  std::vector<std::vector<double>> along;              ///< of every strip, ends of its cells
  std::vector<std::array<std::size_t, 2>> place = {};  ///< of every node: strip and cell

  explicit Rectangles(const FlankPanel& panel) {
    const std::vector<double> lines = distinct(panel.across);
    across = ends_around(lines);
    std::vector<std::vector<double>> places(lines.size());
    const auto nearest = [](const std::vector<double>& rising, double value) {
      const auto closer = [value](double a, double b) { return std::abs(a - value) < std::abs(b - value); };
      return static_cast<std::size_t>(std::ranges::min_element(rising, closer) - rising.begin());
    };
    for (std::size_t i = 0; i < panel.values.size(); ++i)
      places[nearest(lines, panel.across[i])].push_back(panel.along[i]);
    for (std::vector<double>& of_strip : places) {
      std::ranges::sort(of_strip);
      along.push_back(ends_from_edge(of_strip));
    }
    for (std::size_t i = 0; i < panel.values.size(); ++i) {
      const std::size_t strip = nearest(lines, panel.across[i]);
      place.push_back({strip, nearest(places[strip], panel.along[i])});
    }
  }
};

double largest_value(const FlankMap& map) {
  double most = map.full_scale;
  for (const FlankPanel& panel : map.panels)
    for (const double v : panel.values)
      if (std::isfinite(v)) most = std::max(most, v);
  return most;
}

/// An axis in millimetres without ticks beyond its ends.
Scale axis_of(double lower, double upper, int ticks, double from, double to) {
  const double widen = upper > lower ? 0 : 0.5 * kMillimetre;
  Scale scale({}, {.lower = (lower - widen) / kMillimetre, .upper = (upper + widen) / kMillimetre}, ticks, true);
  scale.place(from, to);
  return scale;
}

std::string cells(const FlankPanel& panel, const Rectangles& rectangles, const FlankMap& map, double most,
                  const Scale& x, const Scale& y) {
  std::string text = "<g shape-rendering=\"crispEdges\">";
  for (std::size_t i = 0; i < panel.values.size(); ++i) {
    const auto [strip, cell] = rectangles.place[i];
    const double x0 = rectangles.across[strip], x1 = rectangles.across[strip + 1];
    const double y0 = rectangles.along[strip][cell], y1 = rectangles.along[strip][cell + 1];
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

/// A frame of pixels with the name of the flank and the ticks; along the flank only on the first.
std::string frame(const Eigen::AlignedBox2d& box, const Scale& x, const Scale& y, const std::string& name, bool first) {
  const double left = box.min().x(), top = box.min().y();
  std::string text = fmt::format(
      "<rect x=\"{0:.2f}\" y=\"{1:.2f}\" width=\"{2:.2f}\" height=\"{3:.2f}\" fill=\"none\" stroke=\"var(--base)\"/>"
      "<text class=\"title\" x=\"{0:.2f}\" y=\"{4:.2f}\">{5}</text><g class=\"grid\">",
      left, top, box.sizes().x(), box.sizes().y(), top - 8, escape(name));
  for (std::size_t k = 0; k < x.ticks().at.size(); ++k)
    text += fmt::format("<text class=\"x\" x=\"{:.2f}\" y=\"{:.2f}\">{}</text>", x(x.ticks().at[k]), box.max().y() + 16,
                        x.ticks().labels[k]);
  if (first)
    for (std::size_t k = 0; k < y.ticks().at.size(); ++k)
      text += fmt::format("<text class=\"y\" x=\"{:.2f}\" y=\"{:.2f}\">{}</text>", left - 6, y(y.ticks().at[k]) + 4,
                          y.ticks().labels[k]);
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
  std::string text = svg_begin("plot", map.title, kWidth, kTop + kHeight + kBottom);
  for (std::size_t p = 0; p < map.panels.size(); ++p) {
    const FlankPanel& panel = map.panels[p];
    if (panel.values.empty()) continue;
    const double left = kLeft + static_cast<double>(p) * (width + kGap);
    const Rectangles rectangles(panel);
    double first = rectangles.along.front().front(), last = rectangles.along.front().back();
    for (const std::vector<double>& ends : rectangles.along) {
      first = std::min(first, ends.front());
      last = std::max(last, ends.back());
    }
    const Scale x = axis_of(rectangles.across.front(), rectangles.across.back(), 3, left, left + width);
    const Scale y = axis_of(first, last, 4, kTop, kTop + kHeight);
    text +=
        cells(panel, rectangles, map, most, x, y) +
        frame({Eigen::Vector2d(left, kTop), Eigen::Vector2d(left + width, kTop + kHeight)}, x, y, panel.name, p == 0);
  }
  text += fmt::format(
      "<text class=\"title\" x=\"{:.2f}\" y=\"{:.2f}\" text-anchor=\"middle\">along the slot, mm</text>"
      "<text class=\"title\" transform=\"translate(12 {:.2f}) rotate(-90)\" text-anchor=\"middle\">from the neck side, "
      "mm</text>\n",
      kLeft + (count * width + (count - 1) * kGap) / 2, kTop + kHeight + 34, kTop + kHeight / 2);
  return text + colour_bar(map, most, kWidth - kRight - kBarWidth, kTop, kTop + kHeight) + "</svg>\n";
}

}  // namespace dovetail::report
