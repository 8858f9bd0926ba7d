#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "optimizer/journal/record_fields.hpp"

namespace dovetail::optimizer {

/// How a number that is not finite is written: it does not exist, or as one of the texts "nan", "inf", "-inf".
enum class NotFinite { null, text };

/// A value as JSON: numbers, texts, enumerations by their to_string, optional values (null), complex numbers as pairs,
/// lists, matrices row by row, maps, and records by their tables of fields.
template <class Json, class T>
[[nodiscard]] Json json_value(const T& value, NotFinite otherwise = NotFinite::null) {
  const auto nested = [&](const auto& part) { return json_value<Json>(part, otherwise); };
  if constexpr (std::is_same_v<T, Json> || (std::is_arithmetic_v<T> && !std::is_same_v<T, double>)) {
    return value;
  } else if constexpr (std::is_same_v<T, double>) {
    if (std::isfinite(value)) return value;
    if (otherwise == NotFinite::null) return nullptr;
    return std::isnan(value) ? "nan" : value > 0 ? "inf" : "-inf";
  } else if constexpr (std::is_enum_v<T>) {
    return std::string(to_string(value));
  } else if constexpr (Record<T>) {
    Json object = Json::object();
    each_field<T>([&](const auto& field) { object[field.name] = nested(value.*field.member); });
    return object;
  } else if constexpr (requires { value.has_value(); }) {
    return value ? nested(*value) : Json(nullptr);
  } else if constexpr (requires { typename T::mapped_type; }) {
    Json object = Json::object();
    for (const auto& [key, part] : value) object[key] = nested(part);
    return object;
  } else if constexpr (requires { T::ColsAtCompileTime; }) {
    Json list = Json::array();
    for (std::decay_t<decltype(value.rows())> i = 0; i < value.rows(); ++i)
      if constexpr (T::ColsAtCompileTime == 1)
        list.push_back(nested(value(i)));
      else
        list.push_back(nested(value.row(i).transpose().eval()));
    return list;
  } else if constexpr (requires { value.imag(); }) {
    return Json::array({nested(value.real()), nested(value.imag())});
  } else if constexpr (std::is_convertible_v<T, std::string_view>) {
    return std::string(value);
  } else {
    Json list = Json::array();
    for (const auto& part : value) list.push_back(nested(part));
    return list;
  }
}

/// Reads what json_value wrote; null is a NaN, rows of different lengths are no matrix. Throws std::exception when the
/// JSON is something else.
template <class Json, class T>
void read_json(const Json& json, T& value) {
  if constexpr (std::is_same_v<T, double>) {
    if (json.is_number()) {
      value = json.template get<double>();
      return;
    }
    const std::string text = json.is_null() ? "nan" : json.template get<std::string>();
    if (text != "nan" && text != "inf" && text != "-inf") throw std::runtime_error("'" + text + "' is no number");
    value = text == "nan" ? std::numeric_limits<double>::quiet_NaN()
                          : (text == "inf" ? 1 : -1) * std::numeric_limits<double>::infinity();
  } else if constexpr (Record<T>) {
    each_field<T>([&](const auto& field) {
      if (!field.later || json.contains(field.name)) read_json(json.at(field.name), value.*field.member);
    });
  } else if constexpr (requires { typename T::mapped_type; }) {
    value.clear();
    for (const auto& [key, part] : json.items()) read_json(part, value[key]);
  } else if constexpr (std::is_same_v<T, std::vector<double>>) {
    value.assign(json.size(), 0.0);
    for (std::size_t i = 0; i < value.size(); ++i) read_json(json.at(i), value[i]);
  } else if constexpr (requires { T::ColsAtCompileTime; }) {
    std::vector<std::vector<double>> rows(json.size());
    for (std::size_t i = 0; i < rows.size(); ++i)
      if constexpr (T::ColsAtCompileTime == 1)
        read_json(json.at(i), rows[i].emplace_back());
      else
        read_json(json.at(i), rows[i]);
    const std::size_t columns = rows.empty() ? 0 : rows[0].size();
    const auto shorter = [=](const std::vector<double>& row) { return row.size() != columns; };
    value.resize(std::ranges::any_of(rows, shorter) ? 0 : rows.size(), T::ColsAtCompileTime == 1 ? 1 : columns);
    for (auto i = 0 * value.rows(); i < value.rows(); ++i)
      for (auto k = 0 * i; k < value.cols(); ++k)
        value(i, k) = rows[static_cast<std::size_t>(i)][static_cast<std::size_t>(k)];
  } else {
    value = json.template get<T>();
  }
}

}  // namespace dovetail::optimizer
