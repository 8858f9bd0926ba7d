#include "studies/report/plots/figure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "studies/report/words/html.hpp"
#include "studies/report/words/table.hpp"
#include "studies/report/words/units.hpp"

namespace dovetail::report {

namespace {

std::string column(const PlotAxis& axis, const std::string& name) {
  return PlotAxis{.label = name.empty() ? axis.label : name, .unit = axis.unit}.title();
}

/// Series over the same x share a table.
std::string numbers(const Plot& plot) {
  std::string text;
  std::vector<bool> done(plot.series.size(), false);
  for (std::size_t i = 0; i < plot.series.size(); ++i) {
    const std::vector<double>& x = plot.series[i].x;
    if (done[i] || x.empty()) continue;
    Table table{.columns = {{column(plot.x, "")}}, .rows = std::vector<Row>(x.size()), .named_rows = false};
    for (std::size_t row = 0; row < x.size(); ++row) table.rows[row].cells.emplace_back(plain(x[row], 7));
    for (std::size_t j = i; j < plot.series.size(); ++j) {
      const Series& series = plot.series[j];
      if (done[j] || series.x != x) continue;
      done[j] = true;
      table.columns.push_back({column(plot.y, series.name)});
      for (std::size_t row = 0; row < x.size(); ++row)
        table.rows[row].cells.emplace_back(row < series.y.size() ? significant(series.y[row], 5) : "");
    }
    text += table_html(table);
  }
  return text;
}

std::string numbers(const FlankMap& map) {
  Table table{.columns = {{"flank"}, {"along the slot (mm)"}, {"from the neck side (mm)"}, {map.value_title()}},
              .rows = {},
              .named_rows = false};
  for (const FlankPanel& panel : map.panels)
    for (std::size_t i = 0; i < panel.values.size(); ++i)
      table.rows.push_back({{panel.name, plain(panel.across[i] / 1e-3, 5), plain(panel.along[i] / 1e-3, 5),
                             significant(panel.values[i] / map.unit.si, 5)}});
  return table_html(table);
}

/// Of an empty figure.
std::string nothing(const Plot& plot) {
  const auto known = [](const Series& series) {
    return std::ranges::any_of(series.y, [](double y) { return std::isfinite(y); });
  };
  return !plot.at_zero.empty() && std::ranges::any_of(plot.series, known)
             ? plot.at_zero
             : "Nothing to show: these values were not computed.";
}
std::string nothing(const FlankMap& map) {
  return map.at_zero.empty() ? "Nothing to show: no value above zero." : map.at_zero;
}

std::string csv(const Plot& plot) {
  std::string text = fmt::format("\"line\",\"{}\",\"{}\"\n", plot.x.title(), plot.y.title());
  for (std::size_t s = 0; s < plot.series.size(); ++s) {
    const Series& series = plot.series[s];
    const std::string name = series.name.empty() ? std::to_string(s + 1) : series.name;
    for (std::size_t i = 0; i < std::min(series.x.size(), series.y.size()); ++i)
      text += fmt::format("\"{}\",{:.12g},{}\n", name, series.x[i],
                          std::isfinite(series.y[i]) ? fmt::format("{:.12g}", series.y[i]) : "");
  }
  return text;
}

std::string csv(const FlankMap& map) {
  std::string text = fmt::format("\"flank\",\"along the slot (mm)\",\"from the neck side (mm)\",\"{} ({})\"\n",
                                 map.quantity, map.unit.symbol);
  for (const FlankPanel& panel : map.panels)
    for (std::size_t i = 0; i < panel.values.size(); ++i)
      text += fmt::format("\"{}\",{:.12g},{:.12g},{:.12g}\n", panel.name, panel.across[i] / 1e-3, panel.along[i] / 1e-3,
                          panel.values[i] / map.unit.si);
  return text;
}

}  // namespace

std::string figure_html(const Figure& figure) {
  return std::visit(
      [](const auto& shown) {
        const std::string title = "<h3>" + escape(shown.title) + "</h3>\n";
        if (is_empty(shown))
          return "<figure class=\"nothing\">" + title + "<p>" + escape(nothing(shown)) + "</p></figure>\n";
        return "<figure>" + title + chart_html(shown) +
               (shown.description.empty() ? "" : "<figcaption>" + escape(shown.description) + "</figcaption>\n") +
               folded("numbers", "Numbers", numbers(shown)) + "</figure>\n";
      },
      figure);
}

std::string figures_html(const std::vector<Figure>& figures) {
  std::string text = "<div class=\"grid2\">\n";
  for (const Figure& figure : figures) text += figure_html(figure);
  return text + "</div>\n";
}

std::string figure_csv(const Figure& figure) {
  return std::visit([](const auto& shown) { return csv(shown); }, figure);
}

}  // namespace dovetail::report
