#include "studies/program/engine.hpp"

#include <array>
#include <fstream>
#include <string_view>

#include "reduction/model_file.hpp"
#include "response/condensed_model.hpp"
#include "studies/report/design_record.hpp"

namespace dovetail::studies {

using optimizer::Scene;
using optimizer::SceneEvaluator;

Scene reference_scene(const Study& study) {
  Scene scene = study.scene;
  for (const optimizer::DesignVariable& variable : study.problem.space.variables())
    optimizer::set_parameter(scene, variable.key, variable.lower + (variable.upper - variable.lower) / 2);
  return scene;
}

std::shared_ptr<const SceneEvaluator> scene_evaluator(const Study& study) {
  return std::make_shared<const SceneEvaluator>(reference_scene(study));
}

RunEngine study_engine(const Study& study) {
  const std::shared_ptr<const SceneEvaluator> evaluator = scene_evaluator(study);
  RunEngine engine;
  engine.evaluate = [evaluator, base = study.scene, keys = study.problem.space.keys()](std::span<const double> x) {
    Scene scene = base;
    for (std::size_t i = 0; i < keys.size(); ++i) optimizer::set_parameter(scene, keys[i], x[i]);
    return evaluator->evaluate(scene).evaluation;
  };
  engine.describe = [evaluator](const Scene& scene) {
    return report::make_design_record(scene, evaluator->evaluate(scene));
  };
  return engine;
}

report::DesignRecord describe_fields(const Study& study) {
  return report::make_design_record(study.scene, scene_evaluator(study)->evaluate(study.scene),
                                    {.curve_points = 0, .nodal_diameter_modes = 0, .history_steps = 0});
}

bool is_model_file(const std::string& file) {
  constexpr std::string_view signature("\x89HDF\r\n\x1a\n", 8);
  std::ifstream stream(file, std::ios::binary);
  std::array<char, 8> first{};
  if (stream.read(first.data(), first.size())) return std::string_view(first.data(), first.size()) == signature;
  return file.ends_with(".h5") || file.ends_with(".hdf5");
}

std::vector<Override> with_solver(std::vector<Override> overrides, const SolverOverrides& solver) {
  const auto add = [&](const char* option, const char* key, const std::string& value) {
    overrides.push_back({.key = key, .value = value, .origin = std::string(option) + " " + value});
  };
  if (solver.harmonics) add("--harmonics", "solver.harmonics", std::to_string(*solver.harmonics));
  if (solver.samples) add("--samples", "solver.samples", std::to_string(*solver.samples));
  if (solver.tolerance) add("--tolerance", "solver.tolerance", shortest(*solver.tolerance));
  return overrides;
}

InputError infeasible(const std::string& file, const std::vector<std::string>& messages) {
  std::vector<Violation> found;
  for (const std::string& message : messages)
    found.push_back({.file = file, .key = "the design is infeasible", .value = {}, .allowed = message});
  if (found.empty()) found.push_back({.file = {}, .key = file, .value = {}, .allowed = "the design is infeasible"});
  return InputError(std::move(found));
}

namespace {

LoadedModel from_study(const std::string& file, const std::vector<Override>& overrides) {
  const Study study = load_study(file, overrides);
  const optimizer::CandidateModel candidate = scene_evaluator(study)->builder().build(study.scene);
  if (candidate.status == "infeasible") throw infeasible(file, candidate.messages);
  LoadedModel loaded;
  loaded.steady = optimizer::steady_options(study.scene.solver);
  if (!candidate.converged()) {
    loaded.failure = candidate.status;
    return loaded;
  }
  loaded.model = candidate.reduction.model;
  loaded.condensed = candidate.condensed;
  loaded.glued_omega = candidate.reduction.glued_frequencies(study.scene.loading.mode - 1);
  return loaded;
}

/// A model is solved within the ranges that a study file keeps. Throws InputError naming the options.
void require_ranges(const SolverOverrides& solver) {
  std::vector<Violation> found;
  for (const Override& given : with_solver({}, solver)) {
    const Range& range = optimizer::find_parameter(given.key)->range;
    const bool whole = given.key != "solver.tolerance";
    const double value = !whole                            ? *solver.tolerance
                         : given.key == "solver.harmonics" ? *solver.harmonics
                                                           : *solver.samples;
    if (!range.contains(value))
      found.push_back({.file = {}, .key = given.origin, .value = {}, .allowed = range.phrase()});
  }
  if (!found.empty()) throw InputError(std::move(found));
}

LoadedModel from_file(const std::string& file, const std::vector<Override>& overrides, const SolverOverrides& solver) {
  if (!overrides.empty())
    throw InputError(Violation{.file = file,
                               .key = overrides.front().origin,
                               .value = {},
                               .allowed = "sets a key of a study file, but the input is a reduced model"});
  require_ranges(solver);
  LoadedModel loaded;
  loaded.steady.harmonics = solver.harmonics.value_or(loaded.steady.harmonics);
  loaded.steady.samples = solver.samples.value_or(loaded.steady.samples);
  loaded.steady.tolerance = solver.tolerance.value_or(loaded.steady.tolerance);
  response::validate(loaded.steady);
  loaded.model = reduction::read_model(file);
  loaded.condensed = std::make_shared<const response::CondensedModel>(loaded.model);
  const response::CondensedModel& condensed = *loaded.condensed;
  if (condensed.modal() && condensed.glued_frequencies().size() > 0)
    loaded.glued_omega = condensed.glued_frequencies()[0];
  if (!std::isfinite(loaded.glued_omega) || loaded.glued_omega < 0) loaded.glued_omega = 0;
  return loaded;
}

}  // namespace

LoadedModel load_model(const std::string& input, const std::vector<Override>& overrides,
                       const SolverOverrides& solver) {
  return is_model_file(input) ? from_file(input, overrides, solver) : from_study(input, with_solver(overrides, solver));
}

}  // namespace dovetail::studies
