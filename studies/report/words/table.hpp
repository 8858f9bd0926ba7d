#pragma once

#include <concepts>
#include <string>
#include <string_view>
#include <vector>

#include "studies/report/words/html.hpp"

namespace dovetail::report {

/// Markup that stands as it is.
struct Html {
  std::string text;
};

/// What a table has in one place: text, which is escaped, or markup.
struct Cell {
  std::string html;

  template <std::convertible_to<std::string_view> Text>
  Cell(const Text& text) : html(escape(text)) {}
  Cell(Html markup) : html(std::move(markup.text)) {}
};

/// A text that shows `title` when pointed at.
[[nodiscard]] Html titled(const std::string& text, const std::string& title);

struct Column {
  std::string heading;
  bool text = false;  ///< to the left, as words are; numbers stand to the right
};

struct Row {
  std::vector<Cell> cells;
  std::string style = {};  ///< class of the style sheet
};

struct Table {
  std::vector<Column> columns;  ///< none with a heading: no head
  std::vector<Row> rows;
  std::string style = {};  ///< class of the style sheet
  bool named_rows = true;  ///< the first cell of a row is its heading
};

/// <table> that scrolls by itself where it is too wide.
[[nodiscard]] std::string table_html(const Table& table);

/// Sentences, which are escaped, as a list; empty without any.
[[nodiscard]] std::string list_html(const std::vector<std::string>& sentences);

/// A list of terms, each with what it is; those without are left out.
[[nodiscard]] std::string definition_list(const std::vector<std::pair<std::string, std::string>>& entries);

}  // namespace dovetail::report
