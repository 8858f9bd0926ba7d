#pragma once

#include <map>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "contact/wear_law.hpp"
#include "core/options.hpp"
#include "fem/material.hpp"
#include "geometry/profile/parameters.hpp"
#include "geometry/solid/solid_parameters.hpp"
#include "steady/options.hpp"
#include "wear/follow.hpp"

namespace dovetail::optimizer {

struct SceneKind;  // scene_kind.hpp
extern const SceneKind kSection;
/// The kind of this name; null when there is none.
[[nodiscard]] const SceneKind* find_scene_kind(std::string_view name);

/// Friction and wear of the flanks.
struct ContactProperties {
  double friction = 0.5;                                     ///< mu
  std::string wear_law{contact::wear_laws().front()->name};  ///< one of contact::wear_laws()
  /// Of every law, by its name: a study may give those of laws that it does not use.
  std::map<std::string, contact::WearNumbers> wear = contact::standard_wear_numbers();
  double normal_stiffness = 0;      ///< of the rough interface, N/m^3; 0: rigid
  double tangential_stiffness = 0;  ///< N/m^3; 0: rigid
};

/// What acts on the sector.
struct Loading {
  double speed = 1047.1975511965977;  ///< Omega, rad/s
  double tip_force = 2.0;             ///< amplitude of the tangential force at the aerofoil tip, N
  double damping_ratio = 1e-3;        ///< modal damping of the glued modes
  int nodal_diameter = 0;
  int mode = 1;  ///< glued mode whose resonance is followed, from 1
  wear::Follow follow = wear::Follow::fixed;
};

/// How the stress of the preload gets into the stiffness of the vibrating structure.
enum class Prestress {
  own,     ///< assembled for each design and case
  cases,   ///< assembled for each design, with one friction for all cases, that of the evaluator's reference
  shared,  ///< of flanks without gaps, for all designs with one mesh; what a design's own adds to first order
};
constexpr EnumNames<Prestress, 3> enum_names(Prestress) {
  return {{{Prestress::own, "own"}, {Prestress::cases, "cases"}, {Prestress::shared, "shared"}}};
}
[[nodiscard]] constexpr std::string_view to_string(Prestress prestress) {
  return name_of(prestress);
}

/// Sizes and tolerances of the contact computation.
struct SolverSettings {
  int harmonics = 5;
  int samples = 128;
  int modes = 20;                     ///< free-interface modes kept
  double tolerance = 1e-9;            ///< relative residual of the steady state
  double resonance_tolerance = 1e-7;  ///< of the frequency of a resonance, relative
  double history_tolerance = 2e-3;    ///< local error of a wear history that decides, relative to the largest depth
  Prestress prestress = Prestress::own;
  steady::Solver solver = steady::Solver::automatic;
  double pseudo_penalty = 0;         ///< eps of all contact nodes, N/m; 0: from the model
  double pseudo_penalty_normal = 0;  ///< eps in the normal direction, N/m; 0: pseudo_penalty
  /// Bar over value of the responses asked for, for which mesh, harmonics, samples, modes and the tolerances of
  /// resonance and history are chosen; 0: they stay.
  double accuracy = 0;
  double accuracy_work = 100;  ///< of choosing them, in evaluations of the scene without bars; 0: no limit
  int max_jacobians = 500;  ///< work of one evaluation, in Jacobians in which all contact nodes take part; 0: no limit
  double time_limit = 0;    ///< of one evaluation from the preload on, s; 0: none
};

/// One fully specified candidate: everything the evaluator needs, in SI.
struct Scene {
  const SceneKind* kind = &kSection;  ///< what counts of the rest, and what is made of it
  geometry::ProfileParameters geometry;
  geometry::SolidParameters solid;
  geometry::FeasibilityLimits limits;
  fem::Material blade, disk;
  ContactProperties contact;
  Loading loading;
  geometry::MeshSizes mesh;
  geometry::SolidSizes solid_mesh;
  SolverSettings solver;
};

/// How a study file names the kind of a scene.
struct SceneType {
  std::string type;
};
[[nodiscard]] SceneType type_of(const Scene& scene);

/// Of the bodies of a mesh: blade and disk.
[[nodiscard]] std::vector<fem::Material> materials(const Scene& scene);

}  // namespace dovetail::optimizer

namespace dovetail {

template <>
std::span<const Field<fem::Material>> option_table<fem::Material>();
template <>
std::span<const Field<optimizer::ContactProperties>> option_table<optimizer::ContactProperties>();
template <>
std::span<const Field<optimizer::Loading>> option_table<optimizer::Loading>();
template <>
std::span<const Field<optimizer::SolverSettings>> option_table<optimizer::SolverSettings>();
template <>
std::span<const Field<optimizer::SceneType>> option_table<optimizer::SceneType>();

}  // namespace dovetail

namespace dovetail::optimizer {

/// The fields of Loading written in the section [scene] (speed, nodal diameter, mode) and in [loading].
[[nodiscard]] std::span<const Field<Loading>> scene_loading_fields();
[[nodiscard]] std::span<const Field<Loading>> loading_fields();

/// The numbers of a wear law as fields of a study file.
[[nodiscard]] std::span<const Field<contact::WearNumbers>> wear_fields(const contact::WearLaw& law);

/// The part of visit_tables on the section [contact]. The numbers of the law that is used by default stand before the
/// choice of a law, those of the others after it.
template <class AnyContact, class Visitor>
void visit_contact_tables(AnyContact& contact, Visitor&& visit);

/// Calls visit(section, object, fields) once for each flat struct of a scene: the dotted section of the
/// study file it is read from, the struct (constant when the scene is) and its table. Two structs may
/// share a section. A type that the visitor writes is the scene's from then on, if there is such a kind.
template <class AnyScene, class Visitor>
void visit_tables(AnyScene& scene, Visitor&& visit);

/// What a study file may say about one numeric or textual key of a scene.
struct Parameter {
  std::string key;  ///< dotted path, as for --set
  enum class Kind { real, whole, truth, text } kind = Kind::real;
  Range range;  ///< numbers, in the file's unit
  std::string_view help;
  bool required = false;
  std::vector<std::string_view> choices;
  const contact::WearLaw* wear_law = nullptr;  ///< the one that it is a number of; null: it counts whatever the law

  /// Whether it is a number of a wear law that the scene does not use.
  [[nodiscard]] bool left_aside(const Scene& scene) const {
    return wear_law != nullptr && wear_law->name != scene.contact.wear_law;
  }
};

/// Every key of a scene in the order of the study file. Flank keys appear as "geometry.KEY" (all flanks) and once for
/// each flank: "geometry.left.KEY" and "geometry.right.KEY".
[[nodiscard]] const std::vector<Parameter>& scene_parameters();

/// The entry of scene_parameters() of that key, or nullptr.
[[nodiscard]] const Parameter* find_parameter(std::string_view key);

/// "geometry.left.KEY", ... of a key "geometry.KEY" of all flanks; nothing for others.
[[nodiscard]] std::vector<std::string> flank_keys(std::string_view key);

/// Sets the number of that key, given in the unit of the study file; "geometry.KEY" of a flank key sets
/// all flanks, "contact.friction" also the friction of the self-locking rule. The disk's material stays when the
/// blade's is set. Ranges are
/// not checked (violations() does); throws InputError for an unknown key (with the nearest valid one), a
/// key that is not a number, or a fraction given to a whole number.
void set_parameter(Scene& scene, std::string_view key, double value_in_file_unit);

/// The number of that key in the unit of the study file: the shortest one that sets the same SI value.
/// "geometry.KEY" of a flank key is the first flank's. Throws InputError as set_parameter does.
[[nodiscard]] double parameter(const Scene& scene, std::string_view key);

/// All numbers of a scene by key, in the file's unit. A flank key stands once under "geometry" when all
/// flanks agree, else under "geometry.left" and "geometry.right".
[[nodiscard]] std::map<std::string, double> parameters(const Scene& scene);

/// What contradicts across keys although each value is in its range (fewer samples than the harmonics need).
[[nodiscard]] std::vector<Violation> contradictions(const Scene& scene);

/// Every value outside its range, and what contradicts across keys (e.g. fewer samples than the
/// harmonics need). Empty: the scene may be computed.
[[nodiscard]] std::vector<Violation> violations(const Scene& scene);

template <class AnyContact, class Visitor>
void visit_contact_tables(AnyContact& contact, Visitor&& visit) {
  constexpr const char* kHere = "contact";
  const auto own = option_table<ContactProperties>();
  const auto numbers = [&](const contact::WearLaw* law) {
    visit(kHere, contact.wear.at(std::string(law->name)), wear_fields(*law));
  };
  const auto laws = contact::wear_laws();
  visit(kHere, contact, own.first(1));
  numbers(laws.front());
  visit(kHere, contact, own.subspan(1, 1));
  for (const contact::WearLaw* law : laws.subspan(1)) numbers(law);
  visit(kHere, contact, own.subspan(2));
}

template <class AnyScene, class Visitor>
void visit_tables(AnyScene& scene, Visitor&& visit) {
  SceneType type = type_of(scene);
  visit("scene", type, option_table<SceneType>());
  if constexpr (!std::is_const_v<AnyScene>)
    if (const SceneKind* kind = find_scene_kind(type.type)) scene.kind = kind;
  visit("scene", scene.loading, scene_loading_fields());
  visit("geometry", scene.geometry, option_table<geometry::ProfileParameters>());
  visit("geometry", scene.solid, option_table<geometry::SolidParameters>());
  for (std::size_t f = 0; f < geometry::kFlanks.size(); ++f)
    visit("geometry." + std::string(geometry::kFlanks[f].name), scene.geometry.flanks[f],
          option_table<geometry::FlankParameters>());
  visit("limits", scene.limits, option_table<geometry::FeasibilityLimits>());
  visit("material.blade", scene.blade, option_table<fem::Material>());
  visit("material.disk", scene.disk, option_table<fem::Material>());
  visit_contact_tables(scene.contact, visit);
  visit("loading", scene.loading, loading_fields());
  visit("mesh", scene.mesh, option_table<geometry::MeshSizes>());
  visit("mesh", scene.solid_mesh, option_table<geometry::SolidSizes>());
  visit("solver", scene.solver, option_table<SolverSettings>());
}

}  // namespace dovetail::optimizer
