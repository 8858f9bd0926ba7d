#pragma once

#include <optional>
#include <string_view>

#include "optimizer/candidate/stage.hpp"

namespace dovetail::optimizer {

struct CandidateResult;
struct Scene;

/// Order of the error of a response by the mesh, as its bar counts on it. They were chosen while looking at random
/// designs against meshes four times as fine (studies/error_bars): seeds 1 and 2 in the plane, seed 3 in space.
struct MeshOrder {
  double in_plane;
  double in_space = in_plane;
};

/// By how much what responses are made of may be off. What is not in question has no value: responses of it alone get
/// no entry in their bars.
struct LeftOpen {
  std::optional<double> slip_energy = {};                   ///< J per cycle
  std::optional<double> worn_volume = {}, worn_depth = {};  ///< m^3, m
  std::optional<double> drift = {};                         ///< of the resonance by wear, relative
  std::optional<double> worn_amplitude = {};                ///< m
  std::optional<double> frequency = {};                     ///< of a resonance that was found, relative
};

/// What the computation of a response knows of its own error.
struct OwnError {
  const char* source = nullptr;  ///< which part of the bar it adds to
  double (*of)(const Scene& scene, const CandidateResult& result) = nullptr;
};

/// One scalar an evaluation may answer with: usable as objective or in a constraint.
struct Response {
  std::string_view name;  ///< with its SI unit
  std::string_view unit;  ///< "" when dimensionless
  std::string_view help;  ///< one sentence
  Stage stage;            ///< after which it is known
  double (*value)(const Scene& scene, const CandidateResult& result);

  // What its error bar is made of, see add_error_bars.
  MeshOrder mesh_order;
  double grid_order = 5.0 / 3;  ///< of the error by the length of contact nodes on one mesh
  /// It hangs on where worn zones end: of what a finer mesh and what longer nodes change the larger counts whole, as
  /// two meshes may by accident agree.
  bool by_zone_ends = false;
  /// Coarser meshes do not resolve it: the bars of a study that is about it ask a finer one.
  bool by_finer_mesh = false;
  bool either_sign = false;  ///< good is to be near 0: as an objective it counts by its size unless told otherwise
  bool amount = false;       ///< of which there may be nothing: a bar larger than the value says so
  /// Of the worn joint: the same of the unworn one. Of a joint that does not wear it is at least as uncertain.
  const Response* unworn = nullptr;
  /// Of all cases that act in turn on the same flanks: the same of each by itself. It has no `value` of one candidate,
  /// and its errors fall by the same orders.
  const Response* alone = nullptr;
  /// By how much it is off where these are; nothing where it does not hang on them.
  std::optional<double> (*off)(const CandidateResult& result, const LeftOpen& open) = nullptr;
  OwnError own_error = {};
  bool (*limited)(const Scene& scene) = nullptr;  ///< whether finer meshes come to a limit; null: always
  std::optional<double> largest_bar = {};         ///< over the value; a larger bar is none,
  std::string_view unresolved = "";               ///< and this is said of it

  [[nodiscard]] bool has_limit(const Scene& scene) const { return limited == nullptr || limited(scene); }
};

}  // namespace dovetail::optimizer
