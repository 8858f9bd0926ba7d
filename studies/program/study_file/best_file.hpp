#pragma once

#include <map>
#include <string>

#include "studies/program/study_file/study.hpp"

namespace dovetail::studies {

/// The text of the study file with these keys set to these values (file units, shortest text that reads back to the
/// same double); comments, order and everything else stay. Keys the file leaves to their defaults are added to their
/// section. A file whose layout does not allow that (inline tables) is written anew, without its comments.
/// Reading the result gives exactly these values.
[[nodiscard]] std::string with_values(const Document& document, const std::map<std::string, double>& values);

}  // namespace dovetail::studies
