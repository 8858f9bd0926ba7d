#include "studies/report/plots/flank_map.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "studies/report/plots/chart.hpp"

namespace dovetail::report {

namespace {

using nlohmann::json;

constexpr double kMillimetre = 1e-3;

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

}  // namespace

bool is_empty(const FlankMap& map) {
  return std::none_of(map.panels.begin(), map.panels.end(), [](const FlankPanel& panel) {
    return std::any_of(panel.values.begin(), panel.values.end(), [](double v) { return std::isfinite(v) && v > 0; });
  });
}

std::string chart_html(const FlankMap& map) {
  json panels = json::array();
  for (const FlankPanel& panel : map.panels) {
    if (panel.values.empty()) continue;
    const Rectangles rectangles(panel);
    json cells = json::array();
    for (std::size_t i = 0; i < panel.values.size(); ++i) {
      const auto [strip, cell] = rectangles.place[i];
      json numbers = json::array();
      for (const double place :
           {panel.across[i], panel.along[i], rectangles.across[strip], rectangles.across[strip + 1],
            rectangles.along[strip][cell], rectangles.along[strip][cell + 1]})
        numbers.push_back(chart_number(place / kMillimetre));
      numbers.push_back(chart_number(panel.values[i] / map.unit.si));
      cells.push_back(std::move(numbers));
    }
    panels.push_back({{"name", panel.name}, {"cells", std::move(cells)}});
  }
  return chart_html("map", map.title,
                    {{"quantity", map.quantity},
                     {"unit", map.unit.symbol},
                     {"most", chart_number(largest_value(map) / map.unit.si)},
                     {"panels", std::move(panels)}});
}

}  // namespace dovetail::report
