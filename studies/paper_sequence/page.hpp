#pragma once

#include <filesystem>
#include <string>

#include "studies/paper_sequence/results.hpp"

namespace dovetail::paper_sequence {

/// One self-contained page: the findings, then the reference's figures with what it found and what is found here.
[[nodiscard]] std::string page_html(const Results& results);

/// findings.json, results.json, one CSV per figure and report.html. Throws InputError for what cannot be written.
void write(const std::filesystem::path& folder, const Results& results);

}  // namespace dovetail::paper_sequence
