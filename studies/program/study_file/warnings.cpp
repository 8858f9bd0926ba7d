// What a study says without being wrong, and its writer would want to know.
#include <algorithm>
#include <string>
#include <vector>

#include "core/options.hpp"
#include "optimizer/responses/response_table.hpp"
#include "optimizer/scene/scene_kind.hpp"
#include "studies/program/study_file/study.hpp"

namespace dovetail::studies {
namespace {

/// Outside of these nobody means it: a wrong unit or power of ten.
struct DoubtParams {
  Range modulus{.lower = 1e9, .upper = 1e12};   ///< Pa: plastics to tungsten carbide
  Range density{.lower = 500, .upper = 25000};  ///< kg/m^3: below carbon fibre, above tungsten
  Range limit{.lower = 1e5, .upper = 1e10};     ///< Pa, of a stress or pressure: one bar, and no metal
  double friction = 1.5;                        ///< of dry metals
  int layers = 40;                              ///< along the slot: a hundred thousands of unknowns
};

bool outside(double value, const Range& range) {
  return value < range.lower || value > range.upper;
}

void add_doubts(const Study& study, std::vector<std::string>& result) {
  constexpr DoubtParams kDoubt;
  const optimizer::Scene& scene = study.scene;
  const auto doubt_body = [&](const char* body, const fem::Material& of) {
    const std::string section = std::string("material.") + body;
    if (outside(of.youngs_modulus, kDoubt.modulus))
      result.push_back(section + ".youngs_modulus_gpa = " + shortest(of.youngs_modulus / 1e9) +
                       " is no metal's: is it meant in GPa?");
    if (outside(of.density, kDoubt.density))
      result.push_back(section + ".density_kg_m3 = " + shortest(of.density) + " is no metal's: is it meant in kg/m3?");
  };
  doubt_body("blade", scene.blade);
  if (const std::string disk = "material.disk.";
      std::ranges::any_of(study.given, [&](const std::string& key) { return key.starts_with(disk); }))
    doubt_body("disk", scene.disk);
  if (scene.contact.friction > kDoubt.friction)
    result.push_back("contact.friction = " + shortest(scene.contact.friction) + ": dry metals have less.");
  for (const optimizer::ResponseConstraint& of : study.problem.constraints)
    for (const std::optional<double>& limit : {of.lower, of.upper})
      if (of.response.ends_with("_pa") && limit && outside(*limit, kDoubt.limit))
        result.push_back("the limit " + shortest(*limit) + " Pa of " + of.response +
                         " is far from what metals bear: limits are given in Pa.");
  std::vector<std::string> varied;
  for (const optimizer::DesignVariable& variable : study.problem.space.variables()) {
    varied.push_back(variable.key);
    varied.insert(varied.end(), variable.also.begin(), variable.also.end());
  }
  for (const LinkedKey& linked : study.linked) varied.push_back(linked.key);
  for (const std::string& key : varied)
    if (key.starts_with("contact.") || key.starts_with("material.") || key.starts_with("loading."))
      result.push_back("the variable " + key +
                       " is no dimension that a designer may choose: what is not known for certain belongs into "
                       "[[uncertain]], what changes in service into [[case]].");
  if (scene.kind->in_space && scene.solid_mesh.slot_elements > kDoubt.layers)
    result.push_back("mesh.slot_elements = " + std::to_string(scene.solid_mesh.slot_elements) +
                     " layers along the slot make several 100 000 unknowns and evaluations of minutes.");
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
  add_doubts(study, result);
  return result;
}

}  // namespace dovetail::studies
