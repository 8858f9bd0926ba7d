#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "studies/program/run/run_output.hpp"

/// What a run came to, in words.
namespace dovetail::studies {

/// Counts, the best design with its objective and limits, and where all is written.
[[nodiscard]] std::string conclusion(const Study& study, const optimizer::OptimizationResult& result,
                                     const report::RunRecord& record, const std::filesystem::path& directory);

/// A line for each design that was verified.
[[nodiscard]] std::string verified_words(const std::vector<report::VerificationRecord>& verifications);

/// Where else the best design keeps its limits; nothing where nobody looked.
[[nodiscard]] std::string held_words(const report::RunRecord& record);

/// What keeps the best design from being an answer, or nothing.
[[nodiscard]] std::string shortcoming(const Study& study, const optimizer::OptimizationResult& result,
                                      const WrittenRun& written);

}  // namespace dovetail::studies
