#pragma once

#include <map>
#include <span>
#include <string>

#include "studies/program/study_file/study.hpp"

namespace dovetail::studies {

/// The text of the study file with these keys set to these values (file units, shortest text that reads back to the
/// same double); comments, order and everything else stay. Keys the file leaves to their defaults are added to their
/// section. A file whose layout does not allow that (inline tables) is written anew, without its comments.
/// Reading the result gives exactly these values.
[[nodiscard]] std::string with_values(const Document& document, const std::map<std::string, double>& values);

/// The study with what the command line says of it, as if its file said so: its text does, and a run that keeps it can
/// be resumed, exported and looked up. Throws InputError for the overrides as load_study does.
[[nodiscard]] Study load_rewritten_study(const std::string& file, std::span<const Override> overrides);

}  // namespace dovetail::studies
