// Reading of a structure with the matrices of another finite-element code, which is reduced.
#include <algorithm>
#include <array>
#include <filesystem>
#include <map>
#include <utility>

#include "reduction/massless_boundary.hpp"
#include "reduction/node_pairs.hpp"
#include "reduction/static_condensation.hpp"
#include "reduction/structure_matrices.hpp"
#include "reduction/validation.hpp"
#include "studies/program/engine/contact_values.hpp"
#include "studies/program/engine/model_toml.hpp"
#include "studies/program/engine/node_lists.hpp"
#include "studies/program/study_file/refusal.hpp"

namespace dovetail::studies {
namespace {

constexpr Range kHarmonics{.lower = 0, .upper = 1000};
constexpr Range kDirections{.lower = 1, .upper = 6};
constexpr Range kNodes{.lower = 1, .upper = 2e9};

/// Units of matrices. Stiffness is mass over time squared, whatever the length.
struct Units {
  std::string_view name;
  double stiffness, mass;  ///< SI of one
};
constexpr std::array<Units, 3> kUnits{{{"m, kg, s", 1, 1}, {"mm, t, s", 1e3, 1e3}, {"mm, kg, ms", 1e6, 1}}};

/// A force on degrees of freedom of the structure.
struct Load {
  int harmonic = 0;
  Eigen::VectorXd cosine, sine;  ///< [dofs] N
};

class StructureReader {
 public:
  explicit StructureReader(const Document& document)
      : document_(document),
        problems_(document.file),
        lists_(problems_, "contact.nodes"),
        root_(&document.root, "", problems_) {}

  reduction::ReducedModel read() {
    root_.text("format", {kStructureFormat}, true);
    read_version(root_, problems_);
    const Units units = read_units();
    const std::string stiffness = file("stiffness", true), mass = file("mass", false), dofs = file("dofs", false);
    SectionReader reduction(root_.take("reduction"), "reduction", problems_);
    reduction.fields(options_, option_table<reduction::ReductionOptions>());
    reduction.finish();
    contact();
    problems_.raise();
    structure_ = reduction::read_structure(stiffness, mass, dofs);
    for (std::size_t i = 0; i < structure_.dofs.size(); ++i) row_of_[structure_.dofs[i]] = static_cast<Eigen::Index>(i);
    loads();
    outputs();
    root_.finish();
    problems_.raise();
    return reduced(full(units));
  }

 private:
  Units read_units() {
    std::vector<std::string_view> names;
    for (const Units& units : kUnits) names.push_back(units.name);
    const std::string name = root_.text("units", names).value_or(std::string(kUnits[0].name));
    return *std::ranges::find(kUnits, name, &Units::name);
  }

  /// The path of a file beside the document, or nothing.
  std::string file(const std::string& key, bool needed) {
    const std::optional<std::string> name = root_.text(key, {}, needed);
    return name ? beside(*name) : "";
  }
  [[nodiscard]] std::string beside(const std::string& name) const {
    return (std::filesystem::path(document_.file).parent_path() / name).string();
  }

  std::vector<std::int64_t> nodes_of(const Node& node, const std::string& path) {
    const Eigen::VectorXi numbers = lists_.indices(node, path, "the number of a node");
    return {numbers.begin(), numbers.end()};
  }

  /// A row for each pair, or one vector for all; the first one says in how many directions they meet.
  Eigen::MatrixXd vectors(const Node& node, const std::string& path, Eigen::Index count, Eigen::Index directions) {
    if (!lists_.is_list(node, path, "numbers, or one such list for each contact node") || node.items.empty()) return {};
    const bool one = node.items[0].kind != Node::Kind::list;
    const auto length = static_cast<Eigen::Index>(one ? node.items.size() : node.items[0].items.size());
    const Eigen::Index columns = directions > 0 ? directions : std::clamp<Eigen::Index>(length, 2, 3);
    Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(count, columns);
    if (!one) {
      lists_.rows(node, path, count, columns,
                  [&](const Node& value, const std::string& place, Eigen::Index i, Eigen::Index k) {
                    rows(i, k) = lists_.number(value, place).value_or(0);
                  });
    } else if (length != columns) {
      problems_.add(node, path, "must be a list of " + std::to_string(columns));
    } else {
      for (Eigen::Index k = 0; k < columns; ++k)
        rows.col(k).setConstant(
            lists_.number(node.items[static_cast<std::size_t>(k)], item(path, static_cast<std::size_t>(k)))
                .value_or(0));
    }
    return rows;
  }

  void contact() {
    SectionReader section(root_.take("contact"), "contact", problems_);
    if (const Node* node = required(section, problems_, "nodes", "a list with the node of each pair on the one body"))
      pairs_.nodes = nodes_of(*node, section.path("nodes"));
    const auto count = static_cast<Eigen::Index>(pairs_.nodes.size());
    if (const Node* node = section.take("against")) {
      pairs_.against = nodes_of(*node, section.path("against"));
      if (pairs_.against.size() != pairs_.nodes.size())
        problems_.add(*node, section.path("against"),
                      "must be as many as contact.nodes, " + std::to_string(pairs_.nodes.size()));
    }
    pairs_.normal.setZero(count, 2);
    if (const Node* node = required(section, problems_, "normal", "a direction in the plane or in space"))
      pairs_.normal = vectors(*node, section.path("normal"), count, 0);
    if (const Node* node = section.take("tangent"))
      pairs_.tangent = vectors(*node, section.path("tangent"), count, pairs_.normal.cols());
    contact_.tangential.setZero(count, std::max<Eigen::Index>(pairs_.normal.cols() - 1, 1));
    read_contact_values(section, lists_, problems_, contact_, count);
    section.finish();
  }

  /// The row of `node` and `direction` in the matrices.
  std::optional<Eigen::Index> place(SectionReader& section, const std::string& path) {
    const std::optional<int> node = section.whole("node", kNodes, true);
    const std::optional<int> direction = section.whole("direction", kDirections, true);
    if (!node || !direction) return std::nullopt;
    const auto row = row_of_.find({*node, *direction});
    if (row != row_of_.end()) return row->second;
    problems_.missing(
        section.node(), path,
        "node " + std::to_string(*node) + " has no direction " + std::to_string(*direction) + " in the matrices");
    return std::nullopt;
  }

  /// Values at degrees of freedom: one, or those of a file.
  Eigen::VectorXd unit_load(SectionReader& section, const std::string& path) {
    Eigen::VectorXd load = Eigen::VectorXd::Zero(structure_.stiffness.rows());
    const std::optional<std::string> name = section.text("file");
    if (!name) {
      if (const auto row = place(section, path)) load(*row) = 1;
      return load;
    }
    bool acts = false;
    for (const reduction::NodalForce& force : reduction::read_nodal_forces(beside(*name))) {
      const auto row = row_of_.find(force.at);
      if (row == row_of_.end()) continue;  // where a node is held a force does nothing
      load(row->second) += force.value;
      acts = true;
    }
    if (!acts)
      problems_.missing(section.node(), path + ".file", "has no force at a node and direction of the matrices");
    return load;
  }

  void loads() {
    for (const auto& [node, path] : entries(root_, "force", problems_)) {
      SectionReader section(node, path, problems_);
      const Eigen::VectorXd load = unit_load(section, path);
      const std::optional<int> harmonic = section.whole("harmonic", kHarmonics, true);
      const std::optional<double> cosine = section.number("cosine", kAnyNumber),
                                  sine = section.number("sine", kAnyNumber);
      section.finish();
      if (harmonic == 0 && sine)
        problems_.missing(node, path + ".sine", "a static force (harmonic = 0) has no sine; give cosine");
      if (!cosine && !sine)
        problems_.missing(node, path, "needs cosine or sine, the force in N, or factors of the file's");
      if (harmonic) loads_.push_back({*harmonic, cosine.value_or(0) * load, sine.value_or(0) * load});
    }
  }

  void outputs() {
    for (const auto& [node, path] : entries(root_, "output", problems_)) {
      SectionReader section(node, path, problems_);
      output_names_.push_back(section.text("name", {}, true).value_or("?"));
      output_rows_.push_back(place(section, path).value_or(0));
      section.finish();
    }
  }

  [[nodiscard]] reduction::FullModel full(const Units& units) const {
    Eigen::SparseMatrix<double> to_dofs;
    try {
      to_dofs = reduction::relative_coordinates(structure_.dofs, pairs_);
    } catch (const InputError& error) {
      std::vector<Violation> found = error.violations();
      for (Violation& violation : found) {
        violation.file = document_.file;
        violation.key = "contact." + violation.key;
      }
      throw InputError(std::move(found));
    }
    const Eigen::SparseMatrix<double> from_dofs = to_dofs.transpose();
    const auto turned = [&](const Eigen::SparseMatrix<double>& matrix, double scale) {
      const Eigen::SparseMatrix<double> half = scale * matrix * to_dofs;
      return Eigen::SparseMatrix<double>(from_dofs * half);
    };
    reduction::FullModel model;
    model.stiffness = turned(structure_.stiffness, units.stiffness);
    model.mass = structure_.mass.rows() > 0
                     ? turned(structure_.mass, units.mass)
                     : Eigen::SparseMatrix<double>(model.stiffness.rows(), model.stiffness.cols());
    int harmonics = 0;
    for (const Load& load : loads_) harmonics = std::max(harmonics, load.harmonic);
    model.static_force = Eigen::VectorXd::Zero(model.size());
    model.cosine_force = model.sine_force = Eigen::MatrixXd::Zero(model.size(), harmonics);
    for (const Load& load : loads_) {
      if (load.harmonic == 0) {
        model.static_force += from_dofs * load.cosine;
        continue;
      }
      model.cosine_force.col(load.harmonic - 1) += from_dofs * load.cosine;
      model.sine_force.col(load.harmonic - 1) += from_dofs * load.sine;
    }
    model.outputs.resize(model.size(), static_cast<Eigen::Index>(output_rows_.size()));
    for (std::size_t i = 0; i < output_rows_.size(); ++i)
      model.outputs.col(static_cast<Eigen::Index>(i)) =
          from_dofs * Eigen::VectorXd::Unit(from_dofs.cols(), output_rows_[i]);
    model.output_names = output_names_;
    model.contact = contact_;
    const Eigen::Index d = pairs_.normal.cols(), count = contact_.area.size();
    model.contact.normal.resize(count);
    model.contact.tangential.resize(count, d - 1);
    for (Eigen::Index i = 0; i < count; ++i) {
      const auto first = static_cast<int>(model.size() - d * (count - i));
      model.contact.normal(i) = first;
      for (int k = 1; k < d; ++k) model.contact.tangential(i, k - 1) = first + k;
    }
    return model;
  }

  [[nodiscard]] reduction::ReducedModel reduced(const reduction::FullModel& full) const {
    std::vector<Violation> found = reduction::violations(full);
    for (Violation& violation : found) violation.file = document_.file;
    refuse(std::move(found));
    Status status;
    std::string why;
    reduction::ReducedModel model;
    if (structure_.mass.rows() == 0) {
      reduction::StaticCondensation condensed = reduction::condense_statically(full);
      status = condensed.status;
      why = "with its contact nodes glued the structure is not held";
      model = std::move(condensed.model);
    } else {
      reduction::Reduction massless = reduction::reduce(full, options_);
      status = massless.status;
      why = massless.message;
      model = std::move(massless.model);
    }
    if (status != Status::converged)
      refuse("stiffness", "the structure cannot be reduced (" + std::string(to_string(status)) + "): " + why, {},
             document_.file);
    return model;
  }

  const Document& document_;
  Problems problems_;
  Lists lists_;
  SectionReader root_;
  reduction::ReductionOptions options_;
  reduction::NodePairs pairs_;
  reduction::ContactNodes contact_;
  reduction::StructureMatrices structure_;
  std::map<reduction::NodeDirection, Eigen::Index> row_of_;
  std::vector<Load> loads_;
  std::vector<std::string> output_names_;
  std::vector<Eigen::Index> output_rows_;
};

}  // namespace

reduction::ReducedModel read_structure_document(const Document& document) {
  return StructureReader(document).read();
}

}  // namespace dovetail::studies
