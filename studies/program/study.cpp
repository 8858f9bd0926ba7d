#include "studies/program/study.hpp"

#include <algorithm>
#include <array>
#include <filesystem>

#include "optimizer/scene/responses.hpp"
#include "studies/program/export.hpp"
#include "studies/program/problem_reader.hpp"
#include "studies/program/section_reader.hpp"

namespace dovetail::studies {
namespace {

using geometry::FlankParameters;

/// The file's name without its ending, or its folder's for a file called study.toml.
std::string default_name(const std::string& file) {
  const std::filesystem::path path = std::filesystem::absolute(file).lexically_normal();
  const std::string stem = path.stem().string();
  return stem == "study" && path.parent_path().has_filename() ? path.parent_path().filename().string() : stem;
}

bool is_folder_name(const std::string& name) {
  const auto plain = [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) || c == '-' || c == '_' || c == '.';
  };
  return !name.empty() && name.size() <= 100 && name[0] != '.' && std::all_of(name.begin(), name.end(), plain);
}

/// Keys of [geometry] set both flanks, those of its subsections one; required ones may stand in either.
void read_flanks(SectionReader& geometry, optimizer::Scene& scene, Problems& problems) {
  const auto table = option_table<FlankParameters>();
  FlankParameters both;
  geometry.fields(both, table, false);
  scene.geometry.flank("left") = scene.geometry.flank("right") = both;
  SectionReader left(geometry.take("left"), geometry.path("left"), problems);
  SectionReader right(geometry.take("right"), geometry.path("right"), problems);
  left.fields(scene.geometry.flank("left"), table, false);
  right.fields(scene.geometry.flank("right"), table, false);
  for (const Field<FlankParameters>& field : table) {
    const std::string key(field.key);
    const auto given = [&](const SectionReader& section) { return section.node() && section.node()->find(key); };
    if (field.required && !given(geometry) && !(given(left) && given(right)))
      problems.missing(geometry.node(), geometry.path(key), "is missing; it " + field.range.phrase());
  }
  left.finish();
  right.finish();
}

void read_scene(SectionReader& root, optimizer::Scene& scene, Problems& problems) {
  const auto section = [&](const std::string& key) { return SectionReader(root.take(key), key, problems); };
  SectionReader head = section("scene");
  head.fields(scene, option_table<optimizer::Scene>());
  head.fields(scene.loading, optimizer::scene_loading_fields());
  head.finish();

  SectionReader geometry = section("geometry");
  geometry.fields(scene.geometry, option_table<geometry::ProfileParameters>());
  geometry.fields(scene.solid, option_table<geometry::SolidParameters>());
  read_flanks(geometry, scene, problems);
  geometry.finish();

  SectionReader limits = section("limits");
  limits.fields(scene.limits, option_table<geometry::FeasibilityLimits>());
  limits.finish();

  SectionReader material = section("material");
  SectionReader blade(material.take("blade"), "material.blade", problems);
  blade.fields(scene.blade, option_table<fem::Material>());
  blade.finish();
  scene.disk = scene.blade;
  SectionReader disk(material.take("disk"), "material.disk", problems);
  disk.fields(scene.disk, option_table<fem::Material>(), false);
  disk.finish();
  material.finish();

  SectionReader contact = section("contact");
  contact.fields(scene.contact, option_table<optimizer::ContactProperties>());
  contact.finish();
  scene.limits.friction = scene.contact.friction;

  SectionReader loading = section("loading");
  loading.fields(scene.loading, optimizer::loading_fields());
  loading.finish();

  SectionReader mesh = section("mesh");
  mesh.fields(scene.mesh, option_table<geometry::MeshSizes>());
  mesh.fields(scene.solid_mesh, option_table<geometry::SolidSizes>());
  mesh.finish();

  SectionReader solver = section("solver");
  solver.fields(scene.solver, option_table<optimizer::SolverSettings>());
  solver.finish();
}

void read_exports(SectionReader& root, Study& study, Problems& problems) {
  SectionReader section(root.take("export"), "export", problems);
  std::string allowed = "must be one of";
  for (const std::string_view format : export_formats()) (allowed += ' ') += format;
  if (const Node* formats = section.take("formats")) {
    if (formats->kind != Node::Kind::list)
      problems.add(*formats, "export.formats", "must be a list of formats, as in [\"dxf\"]; each " + allowed);
    for (const Node& item : formats->items) {
      if (item.kind != Node::Kind::text || !is_export_format(item.text))
        problems.add(item, "export.formats", allowed);
      else if (needs_space(item.text) && !study.scene.in_space())
        problems.add(item, "export.formats", "is a surface in space: scene.type must be \"sector\"");
      else if (std::find(study.exports.begin(), study.exports.end(), item.text) == study.exports.end())
        study.exports.push_back(item.text);
    }
  }
  section.finish();
}

/// Contradictions across keys, told at the place of the key that shows them.
void report_contradictions(const Document& document, const optimizer::Scene& scene, Problems& problems) {
  for (const Violation& found : optimizer::contradictions(scene)) {
    if (problems.has(found.key)) continue;
    const std::size_t dot = found.key.find('.');
    const Node* section = document.root.find(found.key.substr(0, dot));
    const Node* value = section ? section->find(found.key.substr(dot + 1)) : nullptr;
    if (value)
      problems.add(*value, found.key, found.allowed);
    else
      problems.missing(section, found.key, "= " + found.value + " by default " + found.allowed);
  }
  // A file may keep the coefficient of the law it does not use; who gives one on the command line expects it to count.
  constexpr const char* kOfArchard = "contact.wear_coefficient_per_pa";
  const Node* coefficient = document.root.at(kOfArchard);
  if (scene.contact.wear_law == "energy" && coefficient && !coefficient->origin.empty())
    problems.add(*coefficient, kOfArchard, "changes nothing with contact.wear_law = \"energy\"");
}

}  // namespace

Study read_study(const Document& document) {
  Study study;
  study.file = document.file;
  study.text = document.text;
  Problems problems(document.file);
  SectionReader root(&document.root, "", problems);
  study.name = root.text("name").value_or(default_name(document.file));
  study.title = root.text("title").value_or(study.name);
  if (const Node* name = root.take("name"); name && name->kind == Node::Kind::text && !is_folder_name(study.name))
    problems.add(*name, "name", "must be letters, digits, '-', '_' and '.', not starting with '.': it names a folder");
  read_scene(root, study.scene, problems);
  report_contradictions(document, study.scene, problems);

  SectionReader optimizer(root.take("optimizer"), "optimizer", problems);
  // In space a mesh four times as fine costs hours.
  if (study.scene.in_space()) study.optimizer.finer_meshes = 1;
  optimizer.fields(study.optimizer, option_table<optimizer::OptimizerOptions>());
  optimizer.finish();

  study.problem = read_problem(root, study.scene, problems);
  read_exports(root, study, problems);
  root.finish();
  problems.raise();
  optimizer::check_terms(study.problem);
  return study;
}

Study load_study(const std::string& file, std::span<const Override> overrides) {
  Document document = load_document(file);
  apply_overrides(document, overrides);
  return read_study(document);
}

std::string physics_text(const optimizer::Scene& scene) {
  std::string text = "scene.type = " + scene.type + "\nsolver.solver = " + scene.solver.solver + "\n";
  for (const auto& [key, value] : optimizer::parameters(scene)) text += key + " = " + shortest(value) + "\n";
  return text;
}

std::vector<std::string> warnings(const Study& study) {
  std::vector<std::string> result;
  const auto leans_on = [&](const std::string& name, const char* what) {
    if (name == "contact_pressure_max_pa" && optimizer::responses_without_limit(study.scene).empty())
      result.push_back(what + (" of " + name) +
                       ": the pressure at the ends of the flanks changes by a fifth from mesh to mesh until "
                       "mesh.flank_elements resolves it: look at its error bar, or take contact_pressure_mean_pa.");
    for (const std::string& without : optimizer::responses_without_limit(study.scene))
      if (name == without)
        result.push_back(
            what + (" of " + name) +
            (study.scene.contact.normal_stiffness > 0
                 ? ": at sharp ends of rough flanks in space it has no error bar; give "
                 : ": at sharp ends of the flanks it grows without limit as the mesh becomes finer; give ") +
            "geometry.flank_edge_radius_mm or take contact_pressure_mean_pa.");
  };
  for (const optimizer::ObjectiveTerm& term : study.problem.objective) leans_on(term.response, "an objective");
  for (const optimizer::ResponseConstraint& limit : study.problem.constraints) leans_on(limit.response, "a limit");
  return result;
}

}  // namespace dovetail::studies
