#include "studies/program/engine/loaded_model.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <ostream>
#include <string_view>
#include <utility>

#include "optimizer/candidate/node_lines.hpp"
#include "quality/truncation.hpp"
#include "reduction/model_file.hpp"
#include "reduction/validation.hpp"
#include "studies/program/engine/engine.hpp"
#include "studies/program/engine/model_toml.hpp"
#include "studies/program/engine/run_folder.hpp"
#include "studies/program/study_file/refusal.hpp"
#include "studies/program/study_file/section_reader.hpp"

namespace dovetail::studies {

bool is_hdf5_file(const std::string& file) {
  constexpr std::string_view signature("\x89HDF\r\n\x1a\n", 8);
  std::ifstream stream(file, std::ios::binary);
  std::array<char, 8> first{};
  if (stream.read(first.data(), first.size())) return std::string_view(first.data(), first.size()) == signature;
  return file.ends_with(".h5") || file.ends_with(".hdf5");
}

std::vector<Override> overrides(const std::vector<std::string>& set, const SolverChoice& solver) {
  std::vector<Override> result;
  std::vector<Violation> found;
  for (const std::string& assignment : set) try {
      result.push_back(parse_override(assignment));
    } catch (const InputError& error) {
      found.insert(found.end(), error.violations().begin(), error.violations().end());
    }
  for (const SolverKey& key : solver_keys()) {
    std::string text = solver.*key.member;
    if (text.empty() || (key.automatic && text == kAutomatic)) continue;
    const std::string origin = key.option() + " " + one_line(text);
    // What is a number but not as TOML writes it: 1., .5, 1E-9
    char* end = nullptr;
    if (const double value = std::strtod(text.c_str(), &end); *end == 0 && text.find_first_of(".eE") != text.npos)
      text = real_text(value);
    if (key.automatic && text.find_first_not_of("+-0123456789") != text.npos)
      found.push_back({.file = {}, .key = origin, .value = {}, .allowed = "must be a whole number or auto"});
    else
      result.push_back({.key = "solver." + std::string(key.key), .value = text, .origin = origin});
  }
  refuse(std::move(found));
  return result;
}

namespace {

/// Before a model is read: options that do not fit are told whatever the file is like.
steady::Options model_options(const std::string& file, const std::vector<std::string>& set,
                              const SolverChoice& solver) {
  if (!set.empty())
    refuse(parse_override(set.front()).origin, "sets a key of a study file, but the input is a reduced model", {},
           file);
  Document document{.file = file, .text = {}, .root = {}};
  document.root.kind = Node::Kind::table;
  apply_overrides(document, overrides({}, solver));
  Problems problems(file);
  optimizer::SolverSettings settings;
  SectionReader(document.root.find("solver"), "solver", problems)
      .fields(settings, option_table<optimizer::SolverSettings>());
  problems.raise();
  return optimizer::steady_options(settings);
}

/// The largest harmonic in which the model is forced.
int largest_harmonic(const reduction::ReducedModel& model) {
  for (Eigen::Index h = model.cosine_force.rows(); h > 0; --h)
    if (!model.cosine_force.row(h - 1).isZero(0) || !model.sine_force.row(h - 1).isZero(0)) return static_cast<int>(h);
  return 0;
}

/// No harmonic of the force may be left out: the default rises to it, and fewer are refused. The default samples
/// rise with the harmonics. Throws InputError.
void fit_to_force(const std::string& file, const SolverChoice& solver, const reduction::ReducedModel& model,
                  steady::Options& steady) {
  const int forced = largest_harmonic(model);
  const auto wrong = [&](const std::string& key, int value, const std::string& allowed) {
    refuse(key, allowed, std::to_string(value), file);
  };
  const auto left_open = [](const std::string& text) { return text.empty() || text == kAutomatic; };
  if (left_open(solver.harmonics)) steady.harmonics = std::max(steady.harmonics, forced);
  if (steady.harmonics < forced)
    wrong("--harmonics", steady.harmonics, "must be >= " + std::to_string(forced) + ", the largest of the force");
  const Range& harmonics = optimizer::find_parameter("solver.harmonics")->range;
  if (!harmonics.contains(steady.harmonics))
    wrong("/force/cosine, harmonics", forced, "of the force with harmonics " + harmonics.phrase());
  if (left_open(solver.samples)) steady.samples = quality::samples_for(steady.harmonics, steady.samples);
  if (steady.samples < 2 * steady.harmonics + 2)
    wrong("--samples", steady.samples,
          "must be >= 2 * harmonics + 2 = " + std::to_string(2 * steady.harmonics + 2) + " for " +
              std::to_string(steady.harmonics) + " harmonics");
}

LoadedModel from_model(const std::string& file, reduction::ReducedModel model, steady::Options steady,
                       const SolverChoice& solver) {
  fit_to_force(file, solver, model, steady);
  LoadedModel loaded;
  loaded.joint.options = steady;
  loaded.model = std::move(model);
  loaded.joint.model = std::make_shared<const dynamics::CondensedModel>(loaded.model);
  // Ascending; those of free motion are no resonance to start from.
  constexpr double kFree = 1e-6;
  const Eigen::VectorXd glued = loaded.joint.model->glued_frequencies();
  for (const double omega : glued)
    if (std::isfinite(omega) && omega > kFree * glued.maxCoeff()) {
      loaded.glued_omega = omega;
      break;
    }
  return loaded;
}

}  // namespace

std::optional<reduction::ReducedModel> read_any_model(const std::string& input) {
  if (is_hdf5_file(input)) return reduction::read_model(input);
  const Document document = load_document(input);
  if (!is_model_document(document)) return std::nullopt;
  return read_model_document(document);
}

LoadedModel take_model(const std::string& name, reduction::ReducedModel model, const SolverChoice& solver) {
  const steady::Options steady = model_options(name, {}, solver);
  std::vector<Violation> found = reduction::violations(model);
  for (Violation& violation : found) violation.file = name;
  refuse(std::move(found));
  return from_model(name, std::move(model), steady, solver);
}

LoadedModel load_model(Study study, std::ostream* err, std::optional<wear::Follow> follow) {
  if (follow) study.scene.loading.follow = *follow;
  if (err != nullptr && study.scene.solver.accuracy > 0)
    *err << study.file
         << ": warning: solver.accuracy chooses nothing here: mesh, modes, harmonics and samples are those of the file "
            "(`dovetail evaluate` chooses and tells them).\n";
  // Of the file's own numbers, which are those of no case.
  if (study.scene.solver.prestress == optimizer::Prestress::cases)
    study.scene.solver.prestress = optimizer::Prestress::own;
  optimizer::CandidateModel candidate = scene_evaluator(study)->builder().build(study.scene);
  if (candidate.infeasible()) throw infeasible(study.file, candidate.messages);
  LoadedModel loaded;
  loaded.joint.options = optimizer::steady_options(study.scene.solver);
  loaded.follow = study.scene.loading.follow;
  loaded.history_tolerance = study.scene.solver.history_tolerance;
  if (!candidate.converged()) {
    loaded.failure = candidate.status;
    if (!candidate.messages.empty()) loaded.failure += ": " + candidate.messages.back();
    return loaded;
  }
  // The same contact nodes as an evaluation has, so that whatever is computed is of one model.
  optimizer::fit_contact(study.scene, {}, candidate);
  if (!candidate.converged()) {
    loaded.failure = candidate.status;
    return loaded;
  }
  loaded.model = candidate.model;
  loaded.joint.model = candidate.condensed;
  loaded.lines = optimizer::node_lines(candidate.cells);
  loaded.glued_omega = candidate.glued_frequencies(study.scene.loading.mode - 1);
  return loaded;
}

LoadedModel load_model(const std::string& given, const std::vector<std::string>& set, const SolverChoice& solver,
                       std::ostream* err, std::optional<wear::Follow> follow,
                       const std::function<void(const Study&)>& begins) {
  const std::string input = study_or_best(given, err);
  if (is_hdf5_file(input)) {
    const steady::Options steady = model_options(input, set, solver);
    return from_model(input, reduction::read_model(input), steady, solver);
  }
  const Document document = load_document(input);
  if (!is_model_document(document)) {
    Study study = load_study(input, overrides(set, solver));
    if (begins) begins(study);
    return load_model(std::move(study), err, follow);
  }
  const steady::Options steady = model_options(input, set, solver);
  return from_model(input, read_model_document(document), steady, solver);
}

}  // namespace dovetail::studies
