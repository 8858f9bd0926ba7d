#pragma once

#include <string>

#include "studies/work_precision/contact_patch.hpp"
#include "studies/work_precision/setting.hpp"

namespace dovetail::work_precision {

/// The resonance of a contact patch near its first glued frequency; a setting's modes and mesh do not concern it.
/// `seconds` is spent at most on repetitions of a timing.
[[nodiscard]] Subject patch_subject(const PatchOptions& options, double seconds);

/// The unworn resonance of the scene of a study file, as an evaluation computes it. Element sizes are those of the file
/// times (its flank elements / the setting's). Models are kept: the same modes and mesh are built once, and their
/// time is that of the first build. Throws InputError for a file that is wrong.
[[nodiscard]] Subject scene_subject(const std::string& study_file, double seconds);

}  // namespace dovetail::work_precision
