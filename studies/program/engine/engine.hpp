#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "optimizer/cases.hpp"
#include "optimizer/evaluation_cost.hpp"
#include "optimizer/evaluator.hpp"
#include "studies/program/engine/run_engine.hpp"
#include "studies/program/study_file/study.hpp"

namespace dovetail::studies {

/// The design at which a run starts: every variable at its start.
[[nodiscard]] optimizer::Scene start_scene(const Study& study);

/// The scene whose geometry fixes the mesh topology of a study: every variable in the middle of its bounds. It does not
/// depend on the values of the variables, so that a best design evaluates in its own file as it did in the run.
[[nodiscard]] optimizer::Scene reference_scene(const Study& study);
/// The same as evaluators have it: what is stressed once for all cases is so with the friction of the first.
[[nodiscard]] optimizer::Scene evaluator_reference(const Study& study);

/// The study's scene with these values of the variables, in the unit of the file.
[[nodiscard]] optimizer::Scene scene_at(const Study& study, std::span<const double> x);

/// The missions of a study that a search evaluates: those of which it names a response. `all`: in a plane section a
/// closer look has those of all cases whatever it names.
[[nodiscard]] std::vector<optimizer::MissionCases> study_missions(const Study& study, bool all);

/// The evaluator of a study, on the reference scene's mesh topology, or on the scene's own where the reference cannot
/// be meshed. Throws InputError when neither can.
[[nodiscard]] std::shared_ptr<const optimizer::SceneEvaluator> scene_evaluator(const Study& study);

/// What an evaluation of the study's design without bars takes, in all its cases; zero where it cannot be meshed.
[[nodiscard]] optimizer::Cost expected_cost(const Study& study);

/// The study's design, in its first case, with its fields and without curves.
/// - `history`: with its wear history, of which up to 16 states are kept
[[nodiscard]] report::DesignRecord describe_fields(const Study& study, bool history = false);

/// The geometric rules of a design: with cases those of every one, under names of of_case.
[[nodiscard]] std::vector<geometry::Rule> rules_in_cases(const optimizer::Scene& design,
                                                         const std::vector<optimizer::LoadCase>& cases);

/// The sentences of the geometric rules that a design breaks.
[[nodiscard]] std::vector<std::string> broken_rules(const optimizer::Scene& scene);

/// The broken rules of an infeasible candidate as input errors of that file.
[[nodiscard]] InputError infeasible(const std::string& file, const std::vector<std::string>& messages);

}  // namespace dovetail::studies
