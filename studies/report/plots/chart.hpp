#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace dovetail::report {

/// As many digits as a drawing can show.
[[nodiscard]] double chart_number(double value);

/// Data of a script of the page.
[[nodiscard]] std::string data_html(const nlohmann::json& data);

/// A place where charts.js draws data of a kind it knows.
[[nodiscard]] std::string chart_html(const std::string& kind, const std::string& title, const nlohmann::json& data);

}  // namespace dovetail::report
