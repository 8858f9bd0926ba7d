#pragma once

#include <filesystem>
#include <vector>

#include "geometry/mesh_motion.hpp"
#include "optimizer/scene.hpp"

namespace dovetail::studies {

/// What an input deck is asked for besides what the scene says.
struct DeckOptions {
  std::vector<int> nodal_diameters;  ///< of the frequency steps; empty: the scene's
  int modes = 10;                    ///< per nodal diameter, >= 1
  bool contact = false;              ///< flanks in frictional contact; false: glued

  bool operator==(const DeckOptions&) const = default;
};

/// The mesh of a scene. Throws InputError when the design cannot be meshed.
[[nodiscard]] geometry::MeshedSector meshed(const optimizer::Scene& scene);

/// Writes the finite elements of a scene with its materials, speed and friction as an input deck of CalculiX
/// (geometry/exports/inp.hpp). Throws InputError when the design cannot be meshed, an option is out of range or the
/// file cannot be written.
void export_deck(const optimizer::Scene& scene, const DeckOptions& options, const std::filesystem::path& file);

}  // namespace dovetail::studies
