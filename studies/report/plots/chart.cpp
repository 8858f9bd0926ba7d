// Figures as data for charts.js, which hands them to the library that draws.
#include "studies/report/plots/chart.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "studies/report/plots/flank_map.hpp"
#include "studies/report/plots/plot.hpp"
#include "studies/report/words/html.hpp"

namespace dovetail::report {

namespace {

using nlohmann::json;

constexpr std::array kRoles{"before", "after", "muted", "bad", "one", "two", "three", "four", "five"};
constexpr std::array kStrokes{"none", "solid", "dashed", "dotted"};
constexpr std::array kMarks{"none", "dot", "circle", "cross", "triangle", "star"};

json axis_json(const PlotAxis& axis) {
  json data{{"label", axis.label}, {"unit", axis.unit},      {"log", axis.logarithmic},
            {"whole", axis.whole}, {"zero", axis.from_zero}, {"tight", axis.tight}};
  if (!axis.range.empty()) data["range"] = {chart_number(axis.range.lower), chart_number(axis.range.upper)};
  return data;
}

/// The value has a place on the axis.
bool drawable(double value, const PlotAxis& axis) {
  return std::isfinite(value) && (!axis.logarithmic || value > 0);
}

json series_json(const Series& series, const Plot& plot) {
  json points = json::array();
  for (std::size_t i = 0; i < std::min(series.x.size(), series.y.size()); ++i)
    points.push_back(drawable(series.x[i], plot.x) && drawable(series.y[i], plot.y)
                         ? json{chart_number(series.x[i]), chart_number(series.y[i])}
                         : json());
  json result{{"name", series.name},
              {"points", std::move(points)},
              {"role", kRoles[static_cast<std::size_t>(series.role)]},
              {"stroke", kStrokes[static_cast<std::size_t>(series.stroke)]},
              {"mark", kMarks[static_cast<std::size_t>(series.mark)]}};
  if (series.steps) result["steps"] = true;
  if (series.shade) result["shade"] = chart_number(*series.shade);
  if (!series.titles.empty()) result["titles"] = series.titles;
  if (!series.labels.empty()) result["labels"] = series.labels;
  if (!series.candidates.empty()) result["candidates"] = series.candidates;
  return result;
}

}  // namespace

double chart_number(double value) {
  return std::isfinite(value) ? std::strtod(fmt::format("{:.7g}", value).c_str(), nullptr) : value;
}

std::string data_html(const json& data) {
  // Neither an end of the element nor a comment may stand in it.
  std::string text = data.dump(-1, ' ', false, json::error_handler_t::replace), safe;
  for (const char c : text)
    if (c == '<')
      safe += "\\u003c";
    else
      safe += c;
  return "<script type=\"application/json\">" + safe + "</script>";
}

std::string chart_html(const std::string& kind, const std::string& title, const json& data) {
  return "<div class=\"chart\" data-kind=\"" + kind + "\" data-title=\"" + escape(title) + "\">" + data_html(data) +
         "</div>\n";
}

void Bounds::add(double value) {
  lower = std::min(lower, value);
  upper = std::max(upper, value);
}

bool is_empty(const Plot& plot) {
  bool any = false, other_than_zero = plot.at_zero.empty();
  for (const Series& series : plot.series)
    for (std::size_t i = 0; i < std::min(series.x.size(), series.y.size()); ++i) {
      if (!drawable(series.x[i], plot.x) || !drawable(series.y[i], plot.y)) continue;
      any = true;
      other_than_zero = other_than_zero || series.y[i] != 0;
    }
  return !any || !other_than_zero;
}

std::string chart_html(const Plot& plot) {
  json data{{"x", axis_json(plot.x)}, {"y", axis_json(plot.y)}, {"series", json::array()}, {"levels", json::array()}};
  for (const Series& series : plot.series) data["series"].push_back(series_json(series, plot));
  for (const PlotLevel& level : plot.levels)
    if (drawable(level.y, plot.y)) data["levels"].push_back({{"name", level.name}, {"y", chart_number(level.y)}});
  if (plot.shaded_below > 0) data["shaded_below"] = chart_number(plot.shaded_below);
  return chart_html("plot", plot.title, data);
}

}  // namespace dovetail::report
