#include "studies/work_precision/evaluations/drawings.hpp"

#include <fmt/format.h>

#include <cmath>

#include "studies/report/words/html.hpp"

namespace dovetail::work_precision {

std::string cell(double value, const char* format) {
  return std::isfinite(value) ? fmt::format(fmt::runtime(format), value) : "\u2013";
}

report::Table table_of(const std::vector<const char*>& headings) {
  report::Table table;
  for (const char* heading : headings) table.columns.push_back({heading});
  return table;
}

std::string drawing(const report::Plot& plot) {
  return "<figure><h4>" + report::escape(plot.title) + "</h4>" +
         (report::is_empty(plot) ? "<p>Nothing converged.</p>" : report::chart_html(plot)) +
         (plot.description.empty() ? "" : "<figcaption>" + report::escape(plot.description) + "</figcaption>") +
         "</figure>\n";
}

std::string side_by_side(const std::string& drawings, const report::Table& table) {
  return "<div class=\"three\">" + drawings + "</div>\n" +
         report::folded("numbers", "Numbers", report::table_html(table));
}

}  // namespace dovetail::work_precision
