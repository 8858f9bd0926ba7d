// What a study says without being wrong, and its writer would want to know.
#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "core/options.hpp"
#include "optimizer/problem/uncertainty.hpp"
#include "optimizer/responses/response_table.hpp"
#include "studies/program/study_file/study.hpp"

namespace dovetail::studies {
namespace {

/// Outside of these nobody means it: a wrong unit or power of ten.
struct DoubtParams {
  Range modulus{.lower = 1, .upper = 1e3};      ///< GPa: plastics to tungsten carbide
  Range density{.lower = 500, .upper = 25000};  ///< kg/m^3: below carbon fibre, above tungsten
  Range friction{.upper = 1.5};                 ///< of dry metals
  Range speed{.upper = 3e5};                    ///< 1/min: the turbines of small turbochargers
  Range damping{.upper = 0.5};                  ///< of a joint and the air around it
  Range limit{.lower = 1e5, .upper = 1e10};     ///< Pa, of a stress or pressure: one bar, and no metal
};
constexpr DoubtParams kDoubt;

/// A key whose numbers are doubted, in its unit.
struct Doubted {
  std::string_view key;
  const Range& usual;
  std::string_view words;
};
constexpr std::string_view kModulus = " is no metal's: is it meant in GPa?",
                           kDensity = " is no metal's: is it meant in kg/m3?";
constexpr std::array<Doubted, 7> kDoubted{
    {{.key = "material.blade.youngs_modulus_gpa", .usual = kDoubt.modulus, .words = kModulus},
     {.key = "material.blade.density_kg_m3", .usual = kDoubt.density, .words = kDensity},
     {.key = "material.disk.youngs_modulus_gpa", .usual = kDoubt.modulus, .words = kModulus},
     {.key = "material.disk.density_kg_m3", .usual = kDoubt.density, .words = kDensity},
     {.key = "contact.friction", .usual = kDoubt.friction, .words = ": dry metals have less."},
     {.key = "scene.speed_rpm", .usual = kDoubt.speed, .words = ": no rotor turns as fast: is it meant in 1/min?"},
     {.key = "loading.damping_ratio", .usual = kDoubt.damping, .words = ": is it meant as a share of 1?"}}};

/// What is to be doubted of that number; empty where nothing is.
std::string doubt(std::string_view key, double value) {
  const auto found = std::ranges::find(kDoubted, key, &Doubted::key);
  if (found == kDoubted.end() || found->usual.contains(value)) return {};
  return std::string(key) + " = " + shortest(value) + std::string(found->words);
}

/// Of numbers that differ from case to case, or are not certain: once, however many samples there are.
void add_doubts_of_cases(const Study& study, std::vector<std::string>& result) {
  for (const optimizer::LoadCase& load : study.problem.cases)
    for (const auto& [key, value, times] : load.changes) {
      const double base = times == 0 ? 0 : times * optimizer::parameter(study.scene, key);
      std::string words = doubt(key, base + value);
      if (times != 0 && times != 1 && base == 0 && value == 0)
        words = key + " = 0: a share of nothing is nothing: give plus_minus.";
      const std::string place = load.sample_of == optimizer::kSampleOfStudy ? "[[uncertain]]"
                                : load.sample_of.empty()                    ? "[[case]] " + load.name
                                                                            : "[[case]] " + load.sample_of;
      const auto told = [&](const std::string& before) { return before.starts_with(place + ": " + key + " = "); };
      if (!words.empty() && std::ranges::none_of(result, told)) result.push_back(place + ": " + words);
    }
}

void add_doubts(const Study& study, std::vector<std::string>& result) {
  for (const Doubted& one : kDoubted) {
    constexpr std::string_view disk = "material.disk.";
    // The disk's are the blade's where nothing is said of them.
    if (one.key.starts_with(disk) &&
        std::ranges::none_of(study.given, [&](const std::string& key) { return key.starts_with(disk); }))
      continue;
    const std::string words = doubt(one.key, optimizer::parameter(study.scene, one.key));
    if (!words.empty()) result.push_back(words);
  }
  add_doubts_of_cases(study, result);
  for (const optimizer::ResponseConstraint& of : study.problem.constraints)
    for (const std::optional<double>& limit : {of.lower, of.upper})
      if (of.response.ends_with("_pa") && limit && !kDoubt.limit.contains(*limit))
        result.push_back("the limit " + shortest(*limit) + " Pa of " + of.response +
                         " is far from what metals bear: limits are given in Pa.");
  const auto doubt_varied = [&](const char* what, const std::string& key) {
    if (key.starts_with("contact.") || key.starts_with("material.") || key.starts_with("loading."))
      result.push_back(what + key +
                       " is no dimension that a designer may choose: what is not known for certain belongs into "
                       "[[uncertain]], what changes in service into [[case]].");
  };
  for (const optimizer::DesignVariable& variable : study.problem.space.variables()) {
    doubt_varied("the variable ", variable.key);
    for (const std::string& key : variable.also) doubt_varied("the variable ", key);
  }
  for (const LinkedKey& linked : study.linked) doubt_varied("the linked key ", linked.key);
}

}  // namespace

std::vector<std::string> warnings(const Study& study) {
  std::vector<std::string> result;
  const auto leans_on = [&](const std::string& name, const char* what) {
    const optimizer::Response* response = optimizer::find_response(name);
    if (response == nullptr) return;
    const bool limit = response->has_limit(study.scene);
    if (response == &optimizer::kContactPressureMax && limit)
      result.push_back(what + (" of " + name) +
                       ": the pressure at the ends of the flanks changes by a fifth from mesh to mesh until "
                       "mesh.flank_elements resolves it: look at its error bar, or take contact_pressure_mean_pa.");
    if (!limit)
      result.push_back(what + (" of " + name) +
                       (study.scene.contact.normal_stiffness > 0
                            ? ": at sharp ends of rough flanks in space it has no error bar; give "
                            : ": at sharp ends of the flanks it grows without limit as the mesh becomes finer; give ") +
                       "geometry.flank_edge_radius_mm or take contact_pressure_mean_pa.");
  };
  for (const optimizer::ObjectiveTerm& term : study.problem.objective) leans_on(term.response, "an objective");
  for (const optimizer::ResponseConstraint& limit : study.problem.constraints) leans_on(limit.response, "a limit");
  const double searched = study.scene.solver.accuracy, handed = study.optimizer.verify_accuracy;
  if (searched > 0 && handed > searched)
    result.push_back(
        "optimizer.verify_accuracy asks for less at the best design than solver.accuracy does of the search: settings "
        "are chosen for it all the same, coarser ones perhaps than those of the search.");
  const auto deviates = [](const auto& term) { return term.over == to_string(optimizer::Over::deviation); };
  if (study.problem.cases.size() == 1 && (std::ranges::any_of(study.problem.objective, deviates) ||
                                          std::ranges::any_of(study.problem.constraints, deviates)))
    result.push_back("of one case or sample there is no deviation: it is 0 whatever the design.");
  add_doubts(study, result);
  return result;
}

}  // namespace dovetail::studies
