#include <fmt/format.h>

#include <cmath>

#include "studies/report/pages/report_tables.hpp"
#include "studies/report/plots/plot.hpp"
#include "studies/report/words/report_words.hpp"
#include "studies/report/words/table.hpp"

namespace dovetail::report {

std::string front_table(const RunRecord& record) {
  if (!record.front) return {};
  const FrontRecord& front = *record.front;
  Table table{.columns = {{"point"}, {"candidate"}}, .rows = {}, .style = "front"};
  std::vector<Unit> units;
  for (std::size_t i = 0; i < front.columns(); ++i) {
    const optimizer::ObjectiveTerm& term = record.problem.objective[i];
    units.push_back(response_unit(term.response, std::abs(front.reference[i])));
    table.columns.push_back({PlotAxis{.label = term_words(record.problem, term), .unit = units.back().symbol}.title()});
  }
  for (const optimizer::DesignVariable& v : record.problem.space.variables())
    table.columns.push_back({PlotAxis{.label = key_words(v.key), .unit = key_unit(v.key)}.title()});
  Table barred = table;
  for (std::size_t point = 0; point < front.evaluation.size(); ++point) {
    const auto candidate = static_cast<std::size_t>(front.evaluation[point]);
    const bool chosen = static_cast<std::int64_t>(point) == front.compromise;
    Row row{.cells = {std::to_string(point + 1), std::to_string(candidate + 1)}, .style = chosen ? "aim" : ""};
    bool known = true;
    for (std::size_t i = 0; i < front.columns(); ++i) {
      row.cells.emplace_back(with_error(front.value(point, i), front.bar(point, i), {.symbol = "", .si = units[i].si}));
      known = known && std::isfinite(front.bar(point, i));
    }
    for (const double x : record.evaluations[candidate].x) row.cells.emplace_back(plain(x, 4));
    if (known || chosen) barred.rows.push_back(row);
    table.rows.push_back(std::move(row));
  }
  const std::string all = fmt::format("All {} points", front.evaluation.size());
  return barred.rows.size() == table.rows.size() ? table_html(table)
                                                 : table_html(barred) + folded("", all, table_html(table));
}

}  // namespace dovetail::report
