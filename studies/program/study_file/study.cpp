#include "studies/program/study_file/study.hpp"

#include <algorithm>
#include <array>
#include <filesystem>
#include <map>
#include <type_traits>

#include "optimizer/candidate/matrices.hpp"
#include "optimizer/responses/response_table.hpp"
#include "optimizer/scene/scene_kind.hpp"
#include "studies/program/study_file/export.hpp"
#include "studies/program/study_file/materials.hpp"
#include "studies/program/study_file/problem_reader.hpp"
#include "studies/program/study_file/section_reader.hpp"
#include "studies/program/study_file/variable_reader.hpp"

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

/// Reads the tables of a scene, each from its section.
class SceneReader {
 public:
  SceneReader(SectionReader& root, optimizer::Scene& scene, Problems& problems)
      : root_(root), scene_(scene), problems_(problems) {}

  void read() {
    read_material();
    optimizer::visit_tables(scene_, [this]<class S>(std::string_view name, S& object, std::span<const Field<S>> table) {
      const std::string path(name);
      if constexpr (std::is_same_v<S, FlankParameters>)
        read_flank(path, object, table);
      else if constexpr (std::is_same_v<S, fem::Material>)
        read_body(path, object, table);
      else
        section(path).fields(object, table);
      if (static_cast<void*>(&object) == &scene_.blade) scene_.disk = scene_.blade;
    });
    for (auto& [path, reader] : sections_) reader.finish();
    scene_.limits.friction = scene_.contact.friction;
  }

 private:
  SectionReader& section(const std::string& path) {
    if (const auto found = sections_.find(path); found != sections_.end()) return found->second;
    const std::size_t dot = path.rfind('.');
    SectionReader& parent = dot == path.npos ? root_ : section(path.substr(0, dot));
    return sections_.emplace(path, SectionReader(parent.take(path.substr(dot + 1)), path, problems_)).first->second;
  }

  /// material = "NAME" says it of both bodies; a table has more to say.
  void read_material() {
    const Node* whole = root_.take("material");
    if (whole == nullptr || whole->kind == Node::Kind::table) return;
    set_material(*whole, "material", scene_.blade);
    named_ = true;
    sections_.emplace("material", SectionReader(nullptr, "material", problems_));
  }

  /// A named material may have single numbers of its own.
  void read_body(const std::string& path, fem::Material& object, std::span<const Field<fem::Material>> table) {
    const Node* grade = section(path).take("grade");
    if (grade != nullptr) set_material(*grade, path + ".grade", object);
    const auto given = [&](const Field<fem::Material>& field) {
      return section(path).node()->find(field.key) != nullptr;
    };
    if (grade != nullptr && std::ranges::all_of(table, given))
      problems_.add(*grade, path + ".grade", "changes nothing, because all numbers of the material are given, too");
    section(path).fields(object, table, !named_ && grade == nullptr && &object != &scene_.disk);
  }

  void set_material(const Node& name, const std::string& path, fem::Material& object) {
    if (const NamedMaterial* found = name.kind == Node::Kind::text ? find_material(name.text) : nullptr) {
      object = found->at_20_c;
      return;
    }
    std::vector<std::string_view> names;
    for (const NamedMaterial& one : named_materials()) names.push_back(one.name);
    problems_.add(name, path, one_of(names) + "; for another material give its numbers in [material.blade]");
  }

  /// Keys of [geometry] set all flanks, those of its subsections one; required ones may stand in either.
  void read_flank(const std::string& path, FlankParameters& flank, std::span<const Field<FlankParameters>> table) {
    SectionReader& all = section("geometry");
    auto& flanks = scene_.geometry.flanks;
    if (&flank == &flanks.front()) {
      all.fields(flank, table, false);
      flanks.fill(flank);
    }
    section(path).fields(flank, table, false);
    if (&flank != &flanks.back()) return;
    for (const Field<FlankParameters>& field : table) {
      const std::string key(field.key);
      const auto given = [&](const SectionReader& in) { return in.node() && in.node()->find(key); };
      const auto of_flank = [&](const geometry::FlankPlace& place) {
        return given(section("geometry." + std::string(place.name)));
      };
      if (field.required && !given(all) && !std::ranges::all_of(geometry::kFlanks, of_flank))
        problems_.missing(all.node(), all.path(key), "is missing; it " + field.range.phrase());
    }
  }

  SectionReader& root_;
  optimizer::Scene& scene_;
  Problems& problems_;
  std::map<std::string, SectionReader> sections_;
  bool named_ = false;  // the material of both bodies
};

void read_exports(SectionReader& root, Study& study, Problems& problems) {
  SectionReader section(root.take("export"), "export", problems);
  const std::string allowed = one_of(names_of<ExportFormat>());
  if (const Node* formats = section.take("formats")) {
    if (formats->kind != Node::Kind::list)
      problems.add(*formats, "export.formats", "must be a list of formats, as in [\"dxf\"]; each " + allowed);
    for (const Node& item : formats->items) {
      const std::optional<ExportFormat> format =
          item.kind == Node::Kind::text ? named<ExportFormat>(item.text) : std::nullopt;
      if (!format)
        problems.add(item, "export.formats", allowed);
      else if (std::ranges::find(study.exports, *format) == study.exports.end())
        study.exports.push_back(*format);
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
  // A file may keep the numbers of the law that is used by default; who gives one on the command line expects it to
  // count.
  for (const optimizer::Parameter& p : optimizer::scene_parameters()) {
    if (p.wear_law != contact::wear_laws().front() || !p.left_aside(scene)) continue;
    const Node* given = document.root.at(p.key);
    if (given && !given->origin.empty()) problems.add(*given, p.key, left_aside_words(scene));
  }
}

/// How designs are stressed at the least cost: with shared matrices where every design has the same mesh, or where
/// that spares cases of one design enough of them.
optimizer::Prestress least_prestress(const Study& study) {
  const auto all_keys = [&](auto&& of) {
    return std::ranges::all_of(study.problem.space.variables(),
                               [&](const optimizer::DesignVariable& variable) {
                                 return of(variable.key) && std::ranges::all_of(variable.also, of);
                               }) &&
           std::ranges::all_of(study.linked, [&](const LinkedKey& linked) { return of(linked.key); });
  };
  if (!study.problem.space.variables().empty() && all_keys(optimizer::shares_matrices))
    return optimizer::Prestress::shared;
  const std::span<const optimizer::LoadCase> cases = study.problem.cases;
  const auto serves = [cases](optimizer::Prestress prestress, std::size_t each) {
    return !cases.empty() && each * optimizer::kinds_of_matrices(cases, prestress) <=
                                 optimizer::kinds_of_matrices(cases, optimizer::Prestress::own);
  };
  // With friction a variable the one that stresses all cases would be nobody's.
  const bool one_friction = all_keys([](std::string_view key) { return key != "contact.friction"; });
  if (one_friction && serves(optimizer::Prestress::cases, 2)) return optimizer::Prestress::cases;
  // What each preload changes in shared ones costs two thirds of its own.
  return serves(optimizer::Prestress::shared, 3) ? optimizer::Prestress::shared : optimizer::Prestress::own;
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
  SceneReader(root, study.scene, problems).read();
  report_contradictions(document, study.scene, problems);
  for (const optimizer::Parameter& p : optimizer::scene_parameters())
    if (document.root.at(p.key)) study.given.insert(p.key);

  SectionReader optimizer(root.take("optimizer"), "optimizer", problems);
  study.optimizer.finer_meshes = std::min(study.optimizer.finer_meshes, study.scene.kind->finer_meshes);
  optimizer.fields(study.optimizer, option_table<optimizer::OptimizerOptions>());
  optimizer.finish();

  study.problem = read_problem(root, study.scene, study.optimizer, problems);
  if (problems.empty()) {
    study.linked = read_linked(root, study.problem, study.scene, problems);
    if (problems.empty() && !study.linked.empty()) report_contradictions(document, study.scene, problems);
  } else {
    static_cast<void>(root.take("linked"));
  }
  // A study without objectives can be evaluated, whatever would search.
  if (!study.problem.objective.empty())
    for (const Violation& found : optimizer::contradictions(study.optimizer, study.problem.front))
      if (const Node* value = document.root.at(found.key)) problems.add(*value, found.key, found.allowed);
  read_exports(root, study, problems);
  root.finish();
  problems.raise();
  optimizer::check_terms(study.problem);
  if (!study.given.contains("solver.prestress")) study.scene.solver.prestress = least_prestress(study);
  return study;
}

Study load_study(const std::string& file, std::span<const Override> overrides) {
  Document document = load_document(file);
  apply_overrides(document, overrides);
  return read_study(document);
}

std::map<std::string, double> settings_at(const Study& study, std::span<const double> x) {
  return with_linked(study.problem.space.settings(x), study.linked);
}

std::string physics_text(const optimizer::Scene& scene) {
  std::string text = "scene.type = " + std::string(scene.kind->name) +
                     "\nsolver.solver = " + std::string(to_string(scene.solver.solver)) + "\n";
  for (const auto& [key, value] : optimizer::parameters(scene)) text += key + " = " + shortest(value) + "\n";
  // Other texts where they are not what they are by default: runs from before a text was there can be resumed.
  optimizer::visit_tables(
      scene, [&]<class S>(std::string_view section, const S& object, std::span<const Field<S>> table) {
        if constexpr (!std::is_same_v<S, optimizer::SceneType>)
          for (const Field<S>& field : table)
            if (const auto word = text_in(object, field);
                word && word != text_in(S{}, field) && !(section == "solver" && field.key == "solver"))
              text += std::string(section) + "." + std::string(field.key) + " = " + *word + "\n";
      });
  return text;
}

}  // namespace dovetail::studies
