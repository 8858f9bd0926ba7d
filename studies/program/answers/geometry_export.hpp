#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "optimizer/scene/scene.hpp"
#include "studies/program/study_file/export.hpp"

namespace dovetail::studies {

/// What an input deck is asked for besides what the scene says.
struct DeckOptions {
  std::vector<int> nodal_diameters;  ///< of the frequency steps; empty: the scene's
  int modes = 10;                    ///< per nodal diameter, >= 1
  bool contact = false;              ///< flanks in frictional contact; false: glued

  bool operator==(const DeckOptions&) const = default;
};

/// Writes a scene in a format without computed fields: the section as a drawing, blade and disk as solids or their
/// surfaces, unworn, or the finite elements with materials, speed and friction as an input deck of CalculiX
/// (geometry/exports/inp.hpp). Throws InputError for a file that cannot be written, a design that cannot be meshed
/// where the format needs a mesh or as a solid, and options out of range.
void export_geometry(const optimizer::Scene& scene, ExportFormat format, const DeckOptions& deck,
                     const std::filesystem::path& file);

}  // namespace dovetail::studies
