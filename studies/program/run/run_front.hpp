#pragma once

#include <filesystem>
#include <string>

#include "studies/program/engine/interrupt.hpp"
#include "studies/program/run/run_output.hpp"

namespace dovetail::studies {

/// Computes bars of `front_points` points of the front, spread over it, and of its compromise. Its candidates are given
/// them; their values stay those of the search. What was
/// computed before, for that fingerprint, is taken from front.jsonl. Nothing without a front.
void add_front_bars(const RunSite& site, const std::string& fingerprint, const OrderlyInterrupt& interrupt,
                    optimizer::OptimizationResult& result);

/// The front as the search found it, and the bars there are.
[[nodiscard]] report::FrontRecord front_record(const optimizer::Problem& problem,
                                               const optimizer::OptimizationResult& result);

/// front.csv, a line for each point, and every point as a study file, front/point_01.toml and so on. Points of an older
/// front are gone.
/// @param result  as the search found it, so that the rows of all points can be compared
void write_front(const std::filesystem::path& directory, const Study& study,
                 const optimizer::OptimizationResult& result);

/// What came of it, for people; without a front nothing.
[[nodiscard]] std::string front_words(const report::RunRecord& record);

}  // namespace dovetail::studies
