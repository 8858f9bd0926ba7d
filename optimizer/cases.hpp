#pragma once

#include <cstddef>
#include <functional>
#include <span>

#include "optimizer/problem/evaluation.hpp"
#include "optimizer/problem/load_case.hpp"
#include "optimizer/scene/scene.hpp"

namespace dovetail::optimizer {

/// The scene as it is in that case.
[[nodiscard]] Scene in_case(Scene scene, const LoadCase& load);
/// In the first of them; without cases as it is.
[[nodiscard]] Scene in_first_case(const Scene& scene, std::span<const LoadCase> cases);

/// What a design came to in every case, in their order; without cases in the one there is. Responses, bars and their
/// sources are those of the first case, and those of every one under the names of of_case. Where a case fails so does
/// the design, and its status names the case; the responses of the others are there. After a case in which the shape is
/// impossible the others count for nothing.
[[nodiscard]] Evaluation together(std::span<const LoadCase> cases, const Scene& scene,
                                  std::span<const Evaluation> in_cases);

/// Evaluates a design in one case: the scene in it, and its place, 0 without cases.
using CaseEvaluator = std::function<Evaluation(const Scene& scene, std::size_t load)>;

/// The same, each case evaluated by itself, one after the other: those that share their matrices in a row.
[[nodiscard]] Evaluation evaluated_in_cases(std::span<const LoadCase> cases, const Scene& scene,
                                            const CaseEvaluator& evaluate);

}  // namespace dovetail::optimizer
