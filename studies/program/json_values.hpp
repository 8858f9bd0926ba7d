#pragma once

#include <Eigen/Core>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

/// Numbers as JSON, for the sources that write JSON: one that is not finite does not exist and is null.
namespace dovetail::studies {

using Json = nlohmann::ordered_json;

[[nodiscard]] inline Json number(double value) {
  return std::isfinite(value) ? Json(value) : Json(nullptr);
}

[[nodiscard]] inline Json numbers(const Eigen::Ref<const Eigen::VectorXd>& values) {
  Json list = Json::array();
  for (const double value : values) list.push_back(number(value));
  return list;
}

[[nodiscard]] inline Json numbers(const std::vector<double>& values) {
  return numbers(Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size())));
}

[[nodiscard]] inline Json numbers(const std::map<std::string, double>& values) {
  Json object = Json::object();
  for (const auto& [key, value] : values) object[key] = number(value);
  return object;
}

/// The text of a document, ending with a newline.
[[nodiscard]] inline std::string text(const Json& json) {
  return json.dump(1, ' ', false, nlohmann::detail::error_handler_t::replace) + "\n";
}

}  // namespace dovetail::studies
