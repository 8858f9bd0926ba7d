#pragma once

#include <filesystem>

#include "optimizer/scene/scene.hpp"
#include "studies/program/study_file/export.hpp"
#include "studies/report/record/run_record.hpp"

namespace dovetail::studies {

/// Writes blade and disk of one sector as solids (geometry/cad/sector_solids.hpp) or, as stl, their surfaces.
/// @param worn  the blade has the flanks that these depths leave; null: as made
/// Throws InputError for a design that makes no solids and a file that cannot be written.
void export_solids(const optimizer::Scene& scene, ExportFormat format, const report::ContactRecord* worn,
                   const std::filesystem::path& file);

}  // namespace dovetail::studies
