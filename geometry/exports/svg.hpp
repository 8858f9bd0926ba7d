#pragma once

#include <Eigen/Geometry>
#include <filesystem>
#include <optional>
#include <span>
#include <string>

#include "geometry/exports/layer.hpp"

namespace dovetail::geometry {

/// A drawing of closed chains as one `<svg>` element, to be written to a file or put into a page: one `<path>` of lines
/// and true arcs per layer, in mm, radial direction upwards, with the layer's name in lower case as its class and
/// title. `window` (m) is what is shown; by default everything, with a margin of 2 %.
[[nodiscard]] std::string svg(std::span<const Layer> layers, const std::optional<Eigen::AlignedBox2d>& window = {});

/// Writes that drawing to a file (beside its place, then renamed). Throws InputError when it cannot be written.
void write_svg(const std::filesystem::path& file, std::span<const Layer> layers,
               const std::optional<Eigen::AlignedBox2d>& window = {});

}  // namespace dovetail::geometry
