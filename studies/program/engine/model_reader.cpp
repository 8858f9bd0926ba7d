// Reading of the reduced model's TOML file.
#include <algorithm>
#include <filesystem>
#include <set>
#include <utility>

#include "reduction/matrix_market.hpp"
#include "reduction/validation.hpp"
#include "studies/program/engine/contact_values.hpp"
#include "studies/program/engine/model_toml.hpp"
#include "studies/program/engine/node_lists.hpp"
#include "studies/program/study_file/refusal.hpp"

namespace dovetail::studies {
namespace {

constexpr const char* kFormat = "dovetail-reduced-model";
constexpr Range kIndices{.lower = 0, .upper = 1e9};
constexpr Range kHarmonics{.lower = 0, .upper = 1000};

/// Reads the file section by section. Matrices come first: they say how many dofs there are.
class ModelReader {
 public:
  explicit ModelReader(const Document& document)
      : document_(document), problems_(document.file), lists_(problems_), root_(&document.root, "", problems_) {}

  reduction::ReducedModel read() {
    root_.text("format", {kFormat}, true);
    read_version(root_, problems_);
    matrix("mass", model_.mass);
    matrix("damping", model_.damping);
    matrix("stiffness", model_.stiffness);
    contact();
    // Whatever is wrong with the matrices is told below; forces and outputs need a size only.
    size_ = std::max({model_.stiffness.rows(), model_.mass.rows(), model_.damping.rows()});
    forces();
    outputs();
    root_.finish();
    problems_.raise();
    std::vector<Violation> found = reduction::violations(model_);
    for (Violation& violation : found) rename(violation);
    refuse(std::move(found));
    return std::move(model_);
  }

 private:
  void matrix(const std::string& key, Eigen::MatrixXd& target) {
    const Node* node = root_.take(key);
    if (!node) return problems_.missing(nullptr, key, "is missing; it must name a Matrix Market file beside this one");
    if (node->kind != Node::Kind::text || node->text.empty())
      return problems_.add(*node, key, "must be the name of a Matrix Market file in quotes");
    const std::filesystem::path folder = std::filesystem::path(document_.file).parent_path();
    target = reduction::read_matrix_market((folder / node->text).string());
  }

  void contact() {
    SectionReader section(root_.take("contact"), "contact", problems_);
    reduction::ContactNodes& contact = model_.contact;
    const auto path = [&](const char* key) { return section.path(key); };
    if (const Node* node = required(section, problems_, "normal", "a list with the normal dof of each contact node"))
      contact.normal = lists_.indices(*node, path("normal"));
    const Eigen::Index count = contact.normal.size();
    Eigen::Index tangents = 1;
    contact.tangential.setZero(count, tangents);
    if (const Node* node =
            required(section, problems_, "tangential", "a list with the tangential dofs of each contact node")) {
      if (node->kind == Node::Kind::list && !node->items.empty() && node->items[0].kind == Node::Kind::list)
        tangents = std::clamp<Eigen::Index>(static_cast<Eigen::Index>(node->items[0].items.size()), 1, 2);
      contact.tangential.setZero(count, tangents);
      lists_.rows(*node, path("tangential"), count, tangents,
                  [&](const Node& value, const std::string& place, Eigen::Index i, Eigen::Index k) {
                    contact.tangential(i, k) = lists_.index(value, place).value_or(0);
                  });
    }
    read_contact_values(section, lists_, problems_, contact, count);
    section.finish();
  }

  /// All [[key]].
  std::vector<Node> sections(const std::string& key) {
    const Node* list = root_.take(key);
    return list && lists_.is_list(*list, key, key + "s: sections [[" + key + "]]") ? list->items : std::vector<Node>();
  }

  /// The dof of a force or output, within the model.
  std::optional<int> dof(const Node& node, const std::string& path) {
    const std::optional<int> index = lists_.index(node, path);
    if (!index || size_ == 0 || *index < size_) return index;
    problems_.add(node, path, "must be a dof from 0 to " + std::to_string(size_ - 1));
    return std::nullopt;
  }

  void forces() {
    struct Term {
      int harmonic, dof;
      double cosine, sine;
    };
    std::vector<Term> terms;
    std::set<std::pair<int, int>> given;
    int harmonics = root_.whole("force_harmonics", kHarmonics).value_or(0);
    const std::vector<Node> list = sections("force");
    for (std::size_t i = 0; i < list.size(); ++i) {
      const Node& node = list[i];
      const std::string path = item("force", i);
      SectionReader section(&node, path, problems_);
      if (!section.present()) continue;
      const Node* place = required(section, problems_, "dof", "the index of a dof, from 0");
      const std::optional<int> at = place ? dof(*place, path + ".dof") : std::nullopt;
      const std::optional<int> harmonic = section.whole("harmonic", kHarmonics, true);
      const std::optional<double> cosine = section.number("cosine", kAnyNumber);
      const std::optional<double> sine = section.number("sine", kAnyNumber);
      section.finish();
      if (!at || !harmonic) continue;
      if (*harmonic == 0 && sine)
        problems_.add(*node.find("sine"), path + ".sine", "a static force (harmonic = 0) has no sine; give cosine");
      if (!node.find("cosine") && !node.find("sine"))
        problems_.missing(&node, path, "needs cosine or sine, the force in N");
      if (!given.emplace(*harmonic, *at).second)
        problems_.missing(&node, path, "the force of this harmonic on this dof is given twice");
      harmonics = std::max(harmonics, *harmonic);
      terms.push_back({*harmonic, *at, cosine.value_or(0), sine.value_or(0)});
    }
    model_.static_force.setZero(size_);
    model_.cosine_force.setZero(harmonics, size_);
    model_.sine_force.setZero(harmonics, size_);
    if (size_ == 0) return;
    for (const Term& term : terms) {
      if (term.harmonic == 0) {
        model_.static_force(term.dof) = term.cosine;
        continue;
      }
      model_.cosine_force(term.harmonic - 1, term.dof) = term.cosine;
      model_.sine_force(term.harmonic - 1, term.dof) = term.sine;
    }
  }

  void outputs() {
    const std::vector<Node> list = sections("output");
    model_.output_vectors.setZero(static_cast<Eigen::Index>(list.size()), size_);
    for (std::size_t i = 0; i < list.size(); ++i) {
      const std::string path = item("output", i);
      SectionReader section(&list[i], path, problems_);
      if (!section.present()) continue;
      model_.output_names.push_back(section.text("name", {}, true).value_or("?"));
      const Node* dofs = required(section, problems_, "dofs", "a list of dofs");
      const Node* factors = section.take("factors");
      section.finish();
      if (!dofs || !lists_.is_list(*dofs, path + ".dofs", "dofs")) continue;
      if (factors && !lists_.is_list(*factors, path + ".factors", "numbers, one for each of dofs")) continue;
      if (factors && factors->items.size() != dofs->items.size()) {
        problems_.missing(factors, path + ".factors", "must be as many as dofs, " + std::to_string(dofs->items.size()));
        continue;
      }
      std::set<int> given;
      for (std::size_t k = 0; k < dofs->items.size(); ++k) {
        const std::optional<int> at = dof(dofs->items[k], item(path + ".dofs", k));
        const double factor = factors ? lists_.number(factors->items[k], item(path + ".factors", k)).value_or(0) : 1.0;
        if (!at) continue;
        if (!given.insert(*at).second)
          problems_.add(dofs->items[k], item(path + ".dofs", k), "must not name a dof twice");
        if (size_ > 0) model_.output_vectors(static_cast<Eigen::Index>(i), *at) = factor;
      }
    }
  }

  /// The names of the model file's data sets as keys of this file.
  void rename(Violation& violation) const {
    violation.file = document_.file;
    std::string key = violation.key.starts_with('/') ? violation.key.substr(1) : violation.key;
    std::replace(key.begin(), key.end(), '/', '.');
    violation.key = key;
  }

  const Document& document_;
  Problems problems_;
  Lists lists_;
  SectionReader root_;
  reduction::ReducedModel model_;
  Eigen::Index size_ = 0;
};

}  // namespace

bool is_model_document(const Document& document) {
  const Node* format = document.root.find("format");
  return format && format->kind == Node::Kind::text && (format->text == kFormat || format->text == kStructureFormat);
}

reduction::ReducedModel read_model_document(const Document& document) {
  const Node* format = document.root.find("format");
  if (format && format->kind == Node::Kind::text && format->text == kStructureFormat)
    return read_structure_document(document);
  return ModelReader(document).read();
}

}  // namespace dovetail::studies
