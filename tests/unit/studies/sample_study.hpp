#pragma once

#include <string>

#include "studies/program/study_file/study_template.hpp"

namespace dovetail::studies {

/// The text with `from` replaced by `to` where it first stands; a test fails when it does not.
std::string replaced(std::string text, const std::string& from, const std::string& to);

/// The text without the lines that start with `start`.
std::string without(const std::string& text, const std::string& start);

/// What read_study says about that text, one sentence per line; empty when it is valid.
std::string complaints(const std::string& text);

}  // namespace dovetail::studies
