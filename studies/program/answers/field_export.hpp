#pragma once

#include <filesystem>

#include "studies/report/record/run_record.hpp"

namespace dovetail::studies {

/// Writes the mesh with the fields of a design (VTK XML, ending .vtu), as far as they were computed: displacement and
/// von Mises stress of the spin-up; on the flanks, and 0 elsewhere, the contact pressure of the spin-up, the slip per
/// cycle at the unworn resonance and the wear depth in the end, each uniform over a contact node's cell; the lowest
/// natural modes with stuck flanks, and their frequencies as field data. Throws InputError when it cannot be written.
void export_fields(const report::DesignRecord& design, const std::filesystem::path& file);

/// Writes a series over the wear history: FILE.pvd, whose times are cycles, and beside it FILE_000.vtu and so on, the
/// mesh with the wear depth of each state that is kept of the history. Throws InputError when a file cannot be written
/// and when there is no history.
void export_history(const report::DesignRecord& design, const std::filesystem::path& file);

}  // namespace dovetail::studies
