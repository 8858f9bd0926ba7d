#pragma once

#include <functional>
#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include "dynamics/condensed_model.hpp"
#include "reduction/reduced_model.hpp"
#include "steady/options.hpp"
#include "studies/program/questions/solver_choice.hpp"
#include "studies/program/study_file/study.hpp"
#include "wear/asymptote/asymptote.hpp"
#include "wear/node_line.hpp"

namespace dovetail::studies {

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
/// - `given`: a model, a study, or the directory of a run: its best design
/// - `err`: hears what of a study does not count here; null: nobody does
/// - `follow`: what drives the wear, where it is not what the study says: contact nodes end where its zones end
/// - `begins`: hears of a study before its model is made, which takes long
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

}  // namespace dovetail::studies
