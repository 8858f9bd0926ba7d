#pragma once

#include <filesystem>
#include <iosfwd>
#include <string>

namespace dovetail::studies {

/// A file in the directory of a run; `what` names it for people. Throws InputError when it is not there.
[[nodiscard]] std::filesystem::path run_file(const std::string& directory, const std::string& name,
                                             const std::string& what);

/// The file that a command is about where it was given `input`: of the directory of a run the study of its best design,
/// which `err`, if there is one, hears in a sentence. Throws InputError for a directory without.
[[nodiscard]] std::string study_or_best(const std::string& input, std::ostream* err);

}  // namespace dovetail::studies
