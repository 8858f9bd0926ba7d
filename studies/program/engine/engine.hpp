#pragma once

#include <functional>
#include <iosfwd>
#include <limits>
#include <memory>
#include <numbers>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "dynamics/condensed_model.hpp"
#include "optimizer/cases.hpp"
#include "optimizer/evaluation_cost.hpp"
#include "optimizer/evaluator.hpp"
#include "reduction/reduced_model.hpp"
#include "steady/options.hpp"
#include "studies/program/engine/run_engine.hpp"
#include "studies/program/questions/solver_choice.hpp"
#include "studies/program/study_file/study.hpp"
#include "wear/asymptote/asymptote.hpp"
#include "wear/node_line.hpp"

namespace dovetail::studies {

inline constexpr double kTurn = 2 * std::numbers::pi;                         ///< rad/s of 1 Hz
inline constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();  ///< null in an answer

/// The design at which a run starts: every variable at its start.
[[nodiscard]] optimizer::Scene start_scene(const Study& study);

/// The scene whose geometry fixes the mesh topology of a study: every variable in the middle of its bounds. It does not
/// depend on the values of the variables, so that a best design evaluates in its own file as it did in the run.
[[nodiscard]] optimizer::Scene reference_scene(const Study& study);

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
/// @param history  with its wear history, of which up to 16 states are kept
[[nodiscard]] report::DesignRecord describe_fields(const Study& study, bool history = false);

/// A reduced model to compute with, from a model file or from a study's candidate.
struct LoadedModel {
  reduction::ReducedModel model;
  steady::Joint joint;                ///< of that model, unworn
  std::vector<wear::NodeLine> lines;  ///< of its contact nodes: a study's strips of cells
  double glued_omega = 0;             ///< rad/s, of the followed mode (a file: the lowest); 0 when the model has none
  wear::Follow follow = wear::Follow::fixed;  ///< the study's choice of what drives the wear
  double history_tolerance = wear::AsymptoteOptions{}.history_tolerance;  ///< of a history that decides: the study's
  std::string failure;  ///< not empty: the candidate's model did not converge, and why
};

/// Whether the file is HDF5 rather than a text: by its first bytes, or its ending when it cannot be read.
[[nodiscard]] bool is_hdf5_file(const std::string& file);

/// The reduced model in an HDF5 or TOML file; nothing when the file is a text but no model (then it should be a study).
/// Throws InputError when it is a model and wrong, or cannot be read.
[[nodiscard]] std::optional<reduction::ReducedModel> read_any_model(const std::string& input);

/// Throws InputError for wrong input and for a study whose geometry is infeasible.
/// @param given   a model, a study, or the directory of a run: its best design
/// @param err     hears what of a study does not count here; null: nobody does
/// @param follow  what drives the wear, where it is not what the study says: contact nodes end where its zones end
/// @param begins  hears of a study before its model is made, which takes long
[[nodiscard]] LoadedModel load_model(const std::string& given, const std::vector<std::string>& set,
                                     const SolverChoice& solver, std::ostream* err = nullptr,
                                     std::optional<wear::Follow> follow = {},
                                     const std::function<void(const Study&)>& begins = {});

/// The same of a reduced model in memory, which messages call by `name`. Throws InputError for one that is not valid.
[[nodiscard]] LoadedModel take_model(const std::string& name, reduction::ReducedModel model,
                                     const SolverChoice& solver);

/// The same of a study that is read already.
[[nodiscard]] LoadedModel load_model(Study study, std::ostream* err = nullptr, std::optional<wear::Follow> follow = {});

/// Those given with --set, and the solver's options as overrides of the keys of [solver]. Throws InputError with all
/// that are not KEY=VALUE, and for numbers that are neither whole nor auto.
[[nodiscard]] std::vector<Override> overrides(const std::vector<std::string>& set, const SolverChoice& solver = {});

/// The sentences of the geometric rules that a design breaks.
[[nodiscard]] std::vector<std::string> broken_rules(const optimizer::Scene& scene);

/// The broken rules of an infeasible candidate as input errors of that file.
[[nodiscard]] InputError infeasible(const std::string& file, const std::vector<std::string>& messages);

}  // namespace dovetail::studies
