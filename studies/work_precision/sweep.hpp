#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/enum_names.hpp"
#include "studies/work_precision/setting.hpp"

namespace dovetail::work_precision {

/// One setting of a sweep, computed, with its errors relative to the reference; NaN when it failed.
struct Point {
  std::string label;  ///< "H = 3"
  Run run = {};
  bool is_default = false;
  std::array<double, 3> error = {};
  std::array<double, 3> own_error = {};  ///< difference to the finest point of the line: this setting's part of it
};

struct Line {
  std::string name;
  std::vector<Point> points;  ///< from coarse to fine
};

/// What a sweep varies.
enum class SweepKey { harmonics, samples, penalty, solver, modes, mesh };
constexpr EnumNames<SweepKey, 6> enum_names(SweepKey) {
  return {{{SweepKey::harmonics, "harmonics"},
           {SweepKey::samples, "samples"},
           {SweepKey::penalty, "penalty"},
           {SweepKey::solver, "solver"},
           {SweepKey::modes, "modes"},
           {SweepKey::mesh, "mesh"}}};
}
[[nodiscard]] constexpr std::string_view to_string(SweepKey key) {
  return name_of(key);
}

/// One setting varied, all others at their defaults.
struct Sweep {
  SweepKey key = SweepKey::harmonics;
  std::string title = {};
  bool with_model_time = false;  ///< seconds are those of model and resonance, not of the resonance alone
  bool refines = false;          ///< points go from coarse to fine, so the last one measures the own error
  std::vector<Line> lines = {};

  [[nodiscard]] double seconds(const Point& point) const {
    return point.run.seconds + (with_model_time ? point.run.model_seconds : 0);
  }
};

/// The finest computation and a second one, fine in another way: what they differ by is how good they are.
struct Reference {
  Run run = {}, check = {};
  std::array<double, 3> agreement = {};
};

/// Every sweep over one model.
struct Diagram {
  std::string key = {}, title = {}, description = {};
  Reference reference = {};                      ///< for all sweeps but that over the mesh
  std::optional<Reference> mesh_reference = {};  ///< finer in the mesh too
  std::vector<Sweep> sweeps = {};

  /// The reference a sweep is compared with.
  [[nodiscard]] const Reference& reference_of(const Sweep& sweep) const {
    return sweep.key == SweepKey::mesh && mesh_reference ? *mesh_reference : reference;
  }
};

/// Computes the two runs of a reference.
[[nodiscard]] Reference refer(const Subject& subject, const Setting& finest, const Setting& check);

/// A point that is only a setting with its label yet.
struct Planned {
  std::string label;
  Setting setting;
};

/// Computes one line of a sweep; errors are filled by `judge`.
[[nodiscard]] Line compute(const Subject& subject, const std::string& name, const std::vector<Planned>& plan,
                           const Setting& defaults);

/// Fills the errors of all points of all sweeps.
void judge(Diagram& diagram);

/// What the default of a sweep errs and costs, beside the next cheaper and the next finer setting, and the cheapest
/// setting that keeps all errors below `goal`. Sentences for people, computed from the points.
[[nodiscard]] std::string verdict(const Sweep& sweep, double goal);

}  // namespace dovetail::work_precision
