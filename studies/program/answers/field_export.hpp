#pragma once

#include <filesystem>

#include "studies/report/record/run_record.hpp"

namespace dovetail::studies {

/// Writes the mesh with the displacement and the von Mises stress of the spin-up (VTK XML, ending .vtu). Throws
/// InputError when it cannot be written.
void export_fields(const report::FieldRecord& fields, const std::filesystem::path& file);

}  // namespace dovetail::studies
