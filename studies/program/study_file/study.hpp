#pragma once

#include <map>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "optimizer/problem/optimizer_options.hpp"
#include "optimizer/problem/problem.hpp"
#include "optimizer/scene/scene.hpp"
#include "studies/program/study_file/document.hpp"
#include "studies/program/study_file/export.hpp"
#include "studies/program/study_file/linked.hpp"

namespace dovetail::studies {

/// A study file, read, complete and valid: everything a command needs, SI except where a key names its unit.
struct Study {
  std::string file;   ///< as the user named it
  std::string text;   ///< the file verbatim
  std::string name;   ///< folder of the results; the file's name (or its folder's for study.toml) unless given
  std::string title;  ///< for people
  optimizer::Scene scene;
  std::set<std::string> given;    ///< keys of the scene that the file or the command line gives
  optimizer::Problem problem;     ///< variables in the file's units; may be without variables and objective
  std::vector<LinkedKey> linked;  ///< what follows from the variables; the scene has it at its own numbers
  optimizer::OptimizerOptions optimizer;
  std::vector<ExportFormat> exports;  ///< formats of the geometry a run writes
};

/// Interprets a document. Throws InputError with everything that is wrong, in the order of the file: unknown keys and
/// sections (with the nearest valid ones), wrong types, values that are not finite or out of range (with the range),
/// missing keys, repeated or conflicting variables, bounds that leave a key's range, unknown responses, contradictory
/// limits, an objective that is missing.
[[nodiscard]] Study read_study(const Document& document);

/// What a study asks for that it had better not, a sentence each: an objective or a limit of a response without a
/// limit.
[[nodiscard]] std::vector<std::string> warnings(const Study& study);

/// load_document, apply_overrides and read_study in one.
[[nodiscard]] Study load_study(const std::string& file, std::span<const Override> overrides = {});

/// What a point of the design space sets in the scene, and what follows from it: keys of the file and their numbers.
[[nodiscard]] std::map<std::string, double> settings_at(const Study& study, std::span<const double> x);

/// The text that fixes what an evaluation of this scene computes: every key and value, one per line.
[[nodiscard]] std::string physics_text(const optimizer::Scene& scene);

}  // namespace dovetail::studies
