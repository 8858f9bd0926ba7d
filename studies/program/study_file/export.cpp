#include "studies/program/study_file/export.hpp"

#include <algorithm>
#include <array>

namespace dovetail::studies {

std::span<const std::string_view> export_formats() {
  static constexpr std::array<std::string_view, 5> formats{"dxf", "svg", "stl", "vtu", "inp"};
  return formats;
}

bool is_export_format(std::string_view format) {
  const std::span<const std::string_view> known = export_formats();
  return std::find(known.begin(), known.end(), format) != known.end();
}

bool is_field_format(std::string_view format) {
  return format == "vtu";
}

bool is_deck_format(std::string_view format) {
  return format == "inp";
}

bool needs_space(std::string_view format) {
  return format == "stl";
}

}  // namespace dovetail::studies
