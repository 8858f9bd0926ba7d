#include "optimizer/scene/scene.hpp"

#include <algorithm>
#include <cmath>
#include <type_traits>

#include "optimizer/scene/scene_kind.hpp"

namespace dovetail::optimizer {

SceneType type_of(const Scene& scene) {
  return {std::string(scene.kind->name)};
}

std::vector<fem::Material> materials(const Scene& scene) {
  return {scene.blade, scene.disk};
}

std::span<const Field<Loading>> scene_loading_fields() {
  return option_table<Loading>().first(3);
}
std::span<const Field<Loading>> loading_fields() {
  return option_table<Loading>().subspan(3);
}

namespace {

constexpr std::string_view kAllFlanks = "geometry";

std::string joined(std::string_view section, std::string_view key) {
  return std::string(section) + "." + std::string(key);
}

template <class S>
Parameter described(std::string_view section, const Field<S>& field) {
  Parameter parameter{.key = joined(section, field.key),
                      .range = field.range,
                      .help = field.help,
                      .required = field.required,
                      .choices = choices_of(field)};
  if (std::holds_alternative<int S::*>(field.member)) parameter.kind = Parameter::Kind::whole;
  if (std::holds_alternative<bool S::*>(field.member)) parameter.kind = Parameter::Kind::truth;
  if (is_text(field)) parameter.kind = Parameter::Kind::text;
  return parameter;
}

std::vector<Parameter> describe_all() {
  std::vector<Parameter> all;
  const Scene scene;
  visit_tables(scene, [&](std::string_view section, const auto& object, auto fields) {
    if (static_cast<const void*>(&object) == &scene.geometry.flanks.front())
      for (const auto& field : fields) all.push_back(described(kAllFlanks, field));
    for (const auto& field : fields) {
      all.push_back(described(section, field));
      if constexpr (std::is_same_v<std::remove_cvref_t<decltype(object)>, contact::WearNumbers>)
        all.back().wear_law = contact::law_with_parameter(field.key);
    }
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

/// Calls use(object, field) for the members that `key` names: one, or the same of every flank.
template <class AnyScene, class Use>
bool visit_key(AnyScene& scene, std::string_view key, Use&& use) {
  bool found = false;
  visit_tables(scene, [&](std::string_view section, auto& object, auto fields) {
    const bool flank = std::is_same_v<std::remove_cvref_t<decltype(object)>, geometry::FlankParameters>;
    for (const auto& field : fields)
      if (joined(section, field.key) == key || (flank && joined(kAllFlanks, field.key) == key)) {
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

std::vector<std::string> flank_keys(std::string_view key) {
  std::vector<std::string> keys;
  if (!key.starts_with(joined(kAllFlanks, "")) || key.find('.') != key.rfind('.')) return keys;
  for (const geometry::FlankPlace& place : geometry::kFlanks) {
    const std::string own = joined(joined(kAllFlanks, place.name), key.substr(key.find('.') + 1));
    if (find_parameter(own) != nullptr) keys.push_back(own);
  }
  return keys;
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
        const auto alike = [&](const S& flank) { return number(flank, field) == value; };
        if (std::ranges::all_of(scene.geometry.flanks, alike)) {
          values[joined(kAllFlanks, field.key)] = value;
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
                  "must be 0: with friction, the vibration of nodal diameter 0 is computed");
  if (scene.loading.mode > scene.solver.modes)
    contradiction("scene.mode", scene.loading.mode,
                  "must be <= solver.modes = " + std::to_string(scene.solver.modes) + ", the modes kept");
  // Of the law that is used by default a file may keep the numbers beside those of another one.
  for (const contact::WearLaw* law : contact::wear_laws().subspan(1)) {
    const std::string name(law->name);
    for (const contact::WearParameter& p : law->parameters)
      if (const double value = scene.contact.wear.at(name).*p.number;
          name != scene.contact.wear_law && value != p.standard)
        contradiction(joined("contact", p.key), value, "has no meaning unless contact.wear_law = \"" + name + "\"");
  }
  for (Violation& own : scene.kind->contradictions(scene)) found.push_back(std::move(own));
  return found;
}

std::vector<Violation> violations(const Scene& scene) {
  std::vector<Violation> found;
  visit_tables(scene, [&]<class S>(std::string_view section, const S& object, std::span<const Field<S>> fields) {
    for (const Field<S>& field : fields) {
      const std::string key = joined(section, field.key);
      if (const std::optional<std::string> text = text_in(object, field)) {
        check_choice(std::string(section), field.key, *text, choices_of(field), found);
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
