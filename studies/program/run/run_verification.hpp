#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "optimizer/search/run.hpp"
#include "studies/program/engine/interrupt.hpp"
#include "studies/program/run/run_output.hpp"

namespace dovetail::studies {

/// Indices of the best feasible designs, best first. Neighbours within 10 % of every variable's range of a better one
/// count as the same design: an algorithm ends among many of them. Of a front its compromise and its ends.
[[nodiscard]] std::vector<std::size_t> best_designs(const optimizer::Problem& problem,
                                                    const optimizer::OptimizationResult& result, int count);

/// The best designs verified, best first. Each is kept in the directory's verification.jsonl as soon as it is done, one
/// JSON object per line, and taken from there when it was done before for the same study (`fingerprint`). A line that
/// is cut short counts for nothing. Stops between designs, and inside one, when interrupted.
/// @param finer  the study at the settings they are verified at; null: RunEngine::verify chooses them
[[nodiscard]] std::vector<report::VerificationRecord> verify_best(const RunSite& site,
                                                                  const optimizer::OptimizationResult& result,
                                                                  const Study* finer, const std::string& fingerprint,
                                                                  const OrderlyInterrupt& interrupt);

}  // namespace dovetail::studies
