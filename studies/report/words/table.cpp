#include "studies/report/words/table.hpp"

#include <algorithm>

namespace dovetail::report {

namespace {

std::string of_class(const std::string& style) {
  return style.empty() ? "" : " class=\"" + style + "\"";
}

std::string row_html(const Table& table, const Row& row) {
  std::string text = "<tr" + of_class(row.style) + ">";
  for (std::size_t i = 0; i < row.cells.size(); ++i) {
    const std::string style = of_class(i < table.columns.size() && table.columns[i].text ? "text" : "");
    text += table.named_rows && i == 0 ? "<th scope=\"row\"" + style + ">" + row.cells[i].html + "</th>"
                                       : "<td" + style + ">" + row.cells[i].html + "</td>";
  }
  return text + "</tr>\n";
}

}  // namespace

Html titled(const std::string& text, const std::string& title) {
  return {"<span title=\"" + escape(title) + "\">" + escape(text) + "</span>"};
}

std::string table_html(const Table& table) {
  std::string text = "<div class=\"scroll\"><table" + of_class(table.style) + ">";
  if (std::ranges::any_of(table.columns, [](const Column& column) { return !column.heading.empty(); })) {
    text += "<thead><tr>";
    for (const Column& column : table.columns)
      text += "<th scope=\"col\"" + of_class(column.text ? "text" : "") + ">" + escape(column.heading) + "</th>";
    text += "</tr></thead>";
  }
  text += "<tbody>\n";
  for (const Row& row : table.rows) text += row_html(table, row);
  return text + "</tbody></table></div>\n";
}

std::string list_html(const std::vector<std::string>& sentences) {
  if (sentences.empty()) return {};
  std::string text = "<ul>\n";
  for (const std::string& sentence : sentences) text += "<li>" + escape(sentence) + "</li>\n";
  return text + "</ul>\n";
}

std::string definition_list(const std::vector<std::pair<std::string, std::string>>& entries) {
  std::string text = "<dl>\n";
  for (const auto& [term, what] : entries)
    if (!what.empty()) text += "<dt>" + escape(term) + "</dt><dd>" + escape(what) + "</dd>\n";
  return text + "</dl>\n";
}

}  // namespace dovetail::report
