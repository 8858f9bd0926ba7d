#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "optimizer/problem/optimizer_options.hpp"
#include "optimizer/problem/problem.hpp"

namespace dovetail::optimizer {

/// FNV-1a, 64 bit. Any change of one byte changes it.
[[nodiscard]] std::uint64_t fnv1a(std::string_view text);

/// 16 lower-case hexadecimal digits.
[[nodiscard]] std::string hexadecimal(std::uint64_t value);

/// Identifies what a journal's evaluations and their order depend on: the problem, the options that move candidates,
/// and `physics`, the text that fixes what the evaluator computes (the study file without [optimizer], or any other).
/// max_evaluations, restarts and what follows the search are left out: a run may be continued with a larger budget.
[[nodiscard]] std::string fingerprint(const Problem& problem, const OptimizerOptions& options,
                                      std::string_view physics = {});

}  // namespace dovetail::optimizer
