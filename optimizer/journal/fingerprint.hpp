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

/// Whether a run may go on with another value of this key of [optimizer]: with more evaluations, or another look at
/// what it found.
[[nodiscard]] bool may_change(std::string_view optimizer_key);

/// Identifies what a journal's evaluations and their order depend on: the problem, the options that move candidates,
/// and `physics`, the text that fixes what the evaluator computes (the study file without [optimizer], or any other).
/// Keys that may change are left out.
[[nodiscard]] std::string fingerprint(const Problem& problem, const OptimizerOptions& options,
                                      std::string_view physics = {});

}  // namespace dovetail::optimizer
