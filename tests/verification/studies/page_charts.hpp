#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace dovetail::work_precision {

/// What the charts of a page are drawn from.
inline std::vector<nlohmann::json> charts_of(const std::string& page) {
  const std::string open = "<script type=\"application/json\">";
  std::vector<nlohmann::json> charts;
  for (std::size_t at = page.find(open); at != std::string::npos; at = page.find(open, at)) {
    at += open.size();
    charts.push_back(nlohmann::json::parse(page.substr(at, page.find("</script>", at) - at)));
  }
  return charts;
}

/// Runs that its charts show as failed ones.
inline std::size_t failures_drawn(const std::string& page) {
  std::size_t drawn = 0;
  for (const nlohmann::json& chart : charts_of(page))
    for (const nlohmann::json& series : chart.value("series", nlohmann::json::array()))
      if (series.at("name") == "failed" && series.at("mark") == "cross")
        for (const nlohmann::json& point : series.at("points")) drawn += point.is_null() ? 0 : 1;
  return drawn;
}

}  // namespace dovetail::work_precision
