#pragma once

#include <filesystem>
#include <iosfwd>

#include "studies/program/engine/run_engine.hpp"
#include "studies/program/study_file/study.hpp"

namespace dovetail::studies {

/// The study with everything that a run chooses before its search, as if it stood in its file: settings for the
/// accuracy it asks for, and the noise of its responses, both of the start. Kept in settings.json of the directory, and
/// with `resume` taken from there when the same was asked for.
[[nodiscard]] Study settled_run(Study study, const std::filesystem::path& directory, bool resume,
                                const RunEngineFactory& make_engine, std::ostream& err);

}  // namespace dovetail::studies
