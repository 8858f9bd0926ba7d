#pragma once

#include <filesystem>
#include <span>

#include "geometry/exports/layer.hpp"

namespace dovetail::geometry {

/// Writes chains as lines and true arcs, in mm, one DXF layer (R2000) per chain. The file is written beside its
/// place and renamed. Throws InputError when it cannot be written.
void write_dxf(const std::filesystem::path& file, std::span<const Layer> layers);

}  // namespace dovetail::geometry
