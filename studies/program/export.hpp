#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "optimizer/scene.hpp"

namespace dovetail::studies {

/// Formats of the section [export] and of the command export.
[[nodiscard]] std::span<const std::string_view> export_formats();

/// Writes the geometry of a scene in one of export_formats(). Throws InputError for another format or a file that
/// cannot be written.
void export_scene(const optimizer::Scene& scene, const std::string& format, const std::filesystem::path& file);

}  // namespace dovetail::studies
