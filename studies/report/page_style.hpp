#pragma once

#include <string>

namespace dovetail::report {

/// Rules for text, tables and figures of a page; its colours are those of plot_style().
[[nodiscard]] std::string page_style();

}  // namespace dovetail::report
