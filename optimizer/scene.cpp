#include "optimizer/scene.hpp"

#include <array>
#include <cmath>
#include <numbers>
#include <type_traits>

namespace dovetail {

template <>
std::span<const Field<fem::Material>> option_table<fem::Material>() {
  using M = fem::Material;
  static const std::array<Field<M>, 3> table{
      Field<M>{.key = "youngs_modulus_gpa",
               .member = &M::youngs_modulus,
               .si_per_unit = 1e9,
               .range = kPositive,
               .help = "Young's modulus"},
      Field<M>{.key = "poisson_ratio",
               .member = &M::poisson_ratio,
               .range = {.lower = 0, .upper = 0.5, .upper_open = true},
               .help = "Poisson's ratio"},
      Field<M>{.key = "density_kg_m3", .member = &M::density, .range = kPositive, .help = "mass density"}};
  return table;
}

template <>
std::span<const Field<optimizer::ContactProperties>> option_table<optimizer::ContactProperties>() {
  using C = optimizer::ContactProperties;
  static const std::array<Field<C>, 2> table{
      Field<C>{.key = "friction",
               .member = &C::friction,
               .range = {.lower = 0, .upper = 2},
               .help = "Coulomb coefficient of friction of the flanks"},
      Field<C>{.key = "wear_coefficient_per_pa",
               .member = &C::wear_coefficient,
               .range = kNonNegative,
               .help = "Archard's k_w: wear depth per pressure and slipped distance"}};
  return table;
}

template <>
std::span<const Field<optimizer::Loading>> option_table<optimizer::Loading>() {
  using L = optimizer::Loading;
  static const std::array<Field<L>, 6> table{
      Field<L>{.key = "speed_rpm",
               .member = &L::speed,
               .si_per_unit = std::numbers::pi / 30,
               .range = kPositive,
               .help = "rotation speed, revolutions per minute",
               .required = true},
      Field<L>{.key = "nodal_diameter",
               .member = &L::nodal_diameter,
               .range = kNonNegative,
               .help = "nodal diameters of the vibration around the disk"},
      Field<L>{.key = "mode",
               .member = &L::mode,
               .range = {.lower = 1, .upper = 100},
               .help = "which mode of that nodal diameter is excited, counted from 1 (glued flanks)"},
      Field<L>{.key = "tip_force_n",
               .member = &L::tip_force,
               .range = kPositive,
               .help = "amplitude of the tangential force on the aerofoil's tip",
               .required = true},
      Field<L>{.key = "damping_ratio",
               .member = &L::damping_ratio,
               .range = {.lower = 0, .upper = 1, .lower_open = true, .upper_open = true},
               .help = "modal damping ratio, friction not counted"},
      Field<L>{.key = "follow",
               .member = &L::follow,
               .help = "what drives the wear; fixed: the unworn resonance, resonance: that of the joint as it wears",
               .choices = {"fixed", "resonance"}}};
  return table;
}

template <>
std::span<const Field<optimizer::SolverSettings>> option_table<optimizer::SolverSettings>() {
  using S = optimizer::SolverSettings;
  static const std::array<Field<S>, 7> table{
      Field<S>{.key = "harmonics",
               .member = &S::harmonics,
               .range = {.lower = 1, .upper = 200},
               .help = "harmonics of the periodic motion"},
      Field<S>{.key = "samples",
               .member = &S::samples,
               .range = {.lower = 8, .upper = 65536},
               .help = "instants per period at which the contact is marched"},
      Field<S>{.key = "modes",
               .member = &S::modes,
               .range = {.lower = 1, .upper = 500},
               .help = "free-interface modes kept in the reduced model"},
      Field<S>{.key = "tolerance",
               .member = &S::tolerance,
               .range = {.lower = 1e-14, .upper = 1e-2},
               .help = "relative residual at which a steady state counts as converged"},
      Field<S>{.key = "solver",
               .member = &S::solver,
               .help = "algorithm for the nonlinear equations; powell_fd: with finite differences, for comparison",
               .choices = {"auto", "newton", "powell", "powell_fd"}},
      Field<S>{.key = "pseudo_penalty_n_per_m",
               .member = &S::pseudo_penalty,
               .range = kNonNegative,
               .help = "pseudo-penalty of all contact nodes; 0: from the model, the local contact stiffness"},
      Field<S>{.key = "pseudo_penalty_normal_n_per_m",
               .member = &S::pseudo_penalty_normal,
               .range = kNonNegative,
               .help = "pseudo-penalty in the normal direction; 0: as pseudo_penalty_n_per_m"}};
  return table;
}

template <>
std::span<const Field<optimizer::Scene>> option_table<optimizer::Scene>() {
  using S = optimizer::Scene;
  static const std::array<Field<S>, 1> table{Field<S>{.key = "type",
                                                      .member = &S::type,
                                                      .help = "what is modelled: a plane section of one sector",
                                                      .required = true,
                                                      .choices = {"section"}}};
  return table;
}

}  // namespace dovetail

namespace dovetail::optimizer {

std::span<const Field<Loading>> scene_loading_fields() {
  return option_table<Loading>().first(3);
}
std::span<const Field<Loading>> loading_fields() {
  return option_table<Loading>().subspan(3);
}

namespace {

constexpr std::string_view kBothFlanks = "geometry";

std::string joined(std::string_view section, std::string_view key) {
  return std::string(section) + "." + std::string(key);
}

template <class S>
Parameter described(std::string_view section, const Field<S>& field) {
  Parameter parameter{.key = joined(section, field.key),
                      .range = field.range,
                      .help = field.help,
                      .required = field.required,
                      .choices = field.choices};
  if (std::holds_alternative<int S::*>(field.member)) parameter.kind = Parameter::Kind::whole;
  if (std::holds_alternative<bool S::*>(field.member)) parameter.kind = Parameter::Kind::truth;
  if (std::holds_alternative<std::string S::*>(field.member)) parameter.kind = Parameter::Kind::text;
  return parameter;
}

std::vector<Parameter> describe_all() {
  std::vector<Parameter> all;
  const Scene scene;
  visit_tables(scene, [&](std::string_view section, const auto&, auto fields) {
    if (section == "geometry.left")
      for (const auto& field : fields) all.push_back(described(kBothFlanks, field));
    for (const auto& field : fields) all.push_back(described(section, field));
  });
  return all;
}

Violation unknown(std::string_view key) {
  std::vector<std::string> keys;
  for (const Parameter& p : scene_parameters()) keys.push_back(p.key);
  const std::string near = nearest(key, keys);
  return {.file = {},
          .key = std::string(key),
          .value = {},
          .allowed = near.empty() ? "is not a parameter" : "is not a parameter; did you mean " + near + "?"};
}

/// The number in the file's unit, without the last-digit noise of the division where a rounder one sets
/// the same member.
double rounded_quotient(double si, double si_per_unit) {
  const double quotient = si / si_per_unit;
  if (!std::isfinite(quotient) || quotient == 0) return quotient;
  const double scale = std::pow(10.0, 14 - std::floor(std::log10(std::abs(quotient))));
  const double rounder = std::round(quotient * scale) / scale;
  return rounder * si_per_unit == si ? rounder : quotient;
}

template <class S>
double number(const S& object, const Field<S>& field) {
  if (const auto* real = std::get_if<double S::*>(&field.member))
    return rounded_quotient(object.*(*real), field.si_per_unit);
  return value_in_file_unit(object, field);
}

/// Calls use(object, field) for the members that `key` names: one, or a pair of flank members.
template <class AnyScene, class Use>
bool visit_key(AnyScene& scene, std::string_view key, Use&& use) {
  bool found = false;
  visit_tables(scene, [&](std::string_view section, auto& object, auto fields) {
    const bool flank = std::is_same_v<std::remove_cvref_t<decltype(object)>, geometry::FlankParameters>;
    for (const auto& field : fields)
      if (joined(section, field.key) == key || (flank && joined(kBothFlanks, field.key) == key)) {
        use(object, field);
        found = true;
      }
  });
  return found;
}

}  // namespace

const std::vector<Parameter>& scene_parameters() {
  static const std::vector<Parameter> all = describe_all();
  return all;
}

const Parameter* find_parameter(std::string_view key) {
  for (const Parameter& p : scene_parameters())
    if (p.key == key) return &p;
  return nullptr;
}

void set_parameter(Scene& scene, std::string_view key, double value) {
  const Parameter* known = find_parameter(key);
  if (!known) throw InputError(unknown(key));
  const bool whole = known->kind == Parameter::Kind::whole;
  if (!whole && known->kind != Parameter::Kind::real)
    throw InputError(
        Violation{.file = {}, .key = std::string(key), .value = shortest(value), .allowed = "is not a number"});
  if (whole && !(value == std::round(value) && std::abs(value) < 1e9))
    throw InputError(
        Violation{.file = {}, .key = std::string(key), .value = shortest(value), .allowed = "must be a whole number"});
  visit_key(scene, key, [&]<class S>(S& object, const Field<S>& field) {
    if (const auto* real = std::get_if<double S::*>(&field.member)) object.*(*real) = value * field.si_per_unit;
    if (const auto* count = std::get_if<int S::*>(&field.member)) object.*(*count) = static_cast<int>(value);
  });
  scene.limits.friction = scene.contact.friction;
}

double parameter(const Scene& scene, std::string_view key) {
  const Parameter* known = find_parameter(key);
  if (!known) throw InputError(unknown(key));
  double value = std::nan("");
  bool first = true;
  visit_key(scene, key, [&]<class S>(const S& object, const Field<S>& field) {
    if (first) value = number(object, field);
    first = false;
  });
  if (std::isnan(value) && (known->kind == Parameter::Kind::text || known->kind == Parameter::Kind::truth))
    throw InputError(Violation{.file = {}, .key = std::string(key), .value = {}, .allowed = "is not a number"});
  return value;
}

std::map<std::string, double> parameters(const Scene& scene) {
  std::map<std::string, double> values;
  visit_tables(scene, [&]<class S>(std::string_view section, const S& object, std::span<const Field<S>> fields) {
    for (const Field<S>& field : fields) {
      if (!std::holds_alternative<double S::*>(field.member) && !std::holds_alternative<int S::*>(field.member))
        continue;
      const double value = number(object, field);
      if constexpr (std::is_same_v<S, geometry::FlankParameters>) {
        if (number(scene.geometry.left, field) == number(scene.geometry.right, field)) {
          values[joined(kBothFlanks, field.key)] = value;
          continue;
        }
      }
      values[joined(section, field.key)] = value;
    }
  });
  return values;
}

std::vector<Violation> contradictions(const Scene& scene) {
  std::vector<Violation> found;
  const auto contradiction = [&](std::string key, double value, std::string allowed) {
    found.push_back({.file = {}, .key = std::move(key), .value = shortest(value), .allowed = std::move(allowed)});
  };
  if (scene.solver.samples < 2 * scene.solver.harmonics + 2)
    contradiction("solver.samples", scene.solver.samples,
                  "must be >= 2 * solver.harmonics + 2 = " + std::to_string(2 * scene.solver.harmonics + 2));
  if (scene.loading.nodal_diameter != 0)
    contradiction("scene.nodal_diameter", scene.loading.nodal_diameter,
                  "must be 0: of a section, the vibration with nodal diameter 0 is computed");
  if (scene.loading.mode > scene.solver.modes)
    contradiction("scene.mode", scene.loading.mode,
                  "must be <= solver.modes = " + std::to_string(scene.solver.modes) + ", the modes kept");
  return found;
}

std::vector<Violation> violations(const Scene& scene) {
  std::vector<Violation> found;
  visit_tables(scene, [&]<class S>(std::string_view section, const S& object, std::span<const Field<S>> fields) {
    for (const Field<S>& field : fields) {
      const std::string key = joined(section, field.key);
      if (const auto* text = std::get_if<std::string S::*>(&field.member)) {
        std::string allowed = "must be one of";
        bool known = field.choices.empty();
        for (const std::string_view choice : field.choices) {
          known = known || object.*(*text) == choice;
          allowed += " " + std::string(choice);
        }
        if (!known) found.push_back({.file = {}, .key = key, .value = object.*(*text), .allowed = allowed});
      } else if (!std::holds_alternative<bool S::*>(field.member)) {
        const double value = number(object, field);
        if (!field.range.contains_rounded(value))
          found.push_back({.file = {}, .key = key, .value = shortest(value), .allowed = field.range.phrase()});
      }
    }
  });
  for (Violation& contradiction : contradictions(scene)) found.push_back(std::move(contradiction));
  return found;
}

}  // namespace dovetail::optimizer
