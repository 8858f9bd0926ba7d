#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include "optimizer/mission/mission_result.hpp"
#include "optimizer/problem/evaluation.hpp"
#include "optimizer/problem/load_case.hpp"
#include "optimizer/problem/missions.hpp"
#include "optimizer/scene/scene.hpp"

namespace dovetail::optimizer {

/// The scene as it is in that case.
[[nodiscard]] Scene in_case(Scene scene, const LoadCase& load);
/// In the first of them; without cases as it is.
[[nodiscard]] Scene in_first_case(const Scene& scene, std::span<const LoadCase> cases);

/// A design in all cases of a mission.
[[nodiscard]] MissionLoads mission_loads(const Scene& scene, std::span<const LoadCase> cases,
                                         const MissionCases& mission);

/// What a design came to in every case, in their order, and then in every mission; without cases in the one there is.
/// Responses, bars and their sources are those of the first case, and those of every one under the names of of_case; a
/// case has those of its mission. Where a case fails so does the design, and its status names the case; the responses
/// of the others are there. After a case in which the shape is impossible the others count for nothing.
[[nodiscard]] Evaluation together(std::span<const LoadCase> cases, const Scene& scene,
                                  std::span<const Evaluation> answers, std::span<const MissionCases> missions = {});

/// Evaluates a design in one case: the scene in it, and its place, 0 without cases.
using CaseEvaluator = std::function<Evaluation(const Scene& scene, std::size_t load)>;
/// In all of a mission, which has that place after the cases.
using MissionEvaluator = std::function<Evaluation(const MissionCases& mission, std::size_t place)>;

/// The same, each case evaluated by itself, one after the other: those that share most in a row. Then the missions,
/// where no case failed.
[[nodiscard]] Evaluation evaluated_in_cases(std::span<const LoadCase> cases, const Scene& scene,
                                            const CaseEvaluator& evaluate, std::span<const MissionCases> missions = {},
                                            const MissionEvaluator& evaluate_mission = {});

}  // namespace dovetail::optimizer
