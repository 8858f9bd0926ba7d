#include "fem/constraints.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "core/errors.hpp"

namespace dovetail::fem {

namespace {

[[noreturn]] void refuse(const std::string& key, const std::string& value, const std::string& allowed) {
  throw InputError({.file = {}, .key = key, .value = value, .allowed = allowed});
}

/// What a node's displacement is made of.
enum class Role { free, bore, right_cut, blade_flank };

void assign(std::vector<Role>& roles, const SectorMesh& sector, int node, Role role, const char* list) {
  if (node < 0 || node >= sector.mesh.node_count()) refuse(list, std::to_string(node), "must be an index of a node");
  Role& current = roles[static_cast<std::size_t>(node)];
  // A bore node on the right cut follows its partner, which is a bore node too.
  if (current == Role::bore && role == Role::right_cut) current = Role::free;
  if (current != Role::free) refuse(list, std::to_string(node), "must not be constrained twice");
  current = role;
}

std::vector<Role> roles_of(const SectorMesh& sector, BoreSupport bore) {
  std::vector<Role> roles(static_cast<std::size_t>(sector.mesh.node_count()), Role::free);
  if (bore != BoreSupport::free)
    for (int node : sector.bore_nodes) assign(roles, sector, node, Role::bore, "sector.bore_nodes");
  for (const std::array<int, 2>& pair : sector.cyclic_pairs)
    assign(roles, sector, pair[1], Role::right_cut, "sector.cyclic_pairs");
  for (const Flank& flank : sector.flanks) {
    if (flank.corner_pairs.size() < 2 || flank.middle_pairs.size() + 1 != flank.corner_pairs.size())
      refuse("sector.flanks." + flank.name, std::to_string(flank.corner_pairs.size()),
             "must have at least two corner pairs and one middle pair between neighbours");
    for (const std::array<int, 2>& pair : flank.corner_pairs)
      assign(roles, sector, pair[0], Role::blade_flank, "sector.flanks.corner_pairs");
    for (const std::array<int, 2>& pair : flank.middle_pairs)
      assign(roles, sector, pair[0], Role::blade_flank, "sector.flanks.middle_pairs");
  }
  return roles;
}

/// Collects the rows of T. Nodes that follow another one take its finished rows.
template <class Scalar>
class TransformationBuilder {
 public:
  TransformationBuilder(const SectorMesh& sector, BoreSupport bore, Scalar phase_factor)
      : sector_(sector), bore_(bore), phase_factor_(phase_factor), roles_(roles_of(sector, bore)) {
    rows_.resize(2 * roles_.size());
  }

  Constraints<Scalar> build() {
    number_internal();
    follow_cuts();
    follow_flanks();
    Constraints<Scalar> result;
    result.internal_count = internal_;
    result.contact_count = columns_ - internal_;
    std::vector<Eigen::Triplet<Scalar>> entries;
    for (std::size_t row = 0; row < rows_.size(); ++row)
      for (const Term& term : rows_[row])
        entries.emplace_back(static_cast<int>(row), static_cast<int>(term.column), term.factor);
    result.transformation.resize(static_cast<Eigen::Index>(rows_.size()), columns_);
    result.transformation.setFromTriplets(entries.begin(), entries.end());
    return result;
  }

 private:
  struct Term {
    Eigen::Index column;
    Scalar factor;
  };
  using Row = std::vector<Term>;

  Row& row(int node, int component) { return rows_[static_cast<std::size_t>(2 * node + component)]; }

  void number_internal() {
    for (int node = 0; node < sector_.mesh.node_count(); ++node) {
      const Role role = roles_[static_cast<std::size_t>(node)];
      if (role == Role::free) {
        for (int c = 0; c < 2; ++c) row(node, c).push_back({columns_++, Scalar(1)});
      } else if (role == Role::bore && bore_ == BoreSupport::tangential) {
        const Eigen::Vector2d radial = sector_.mesh.nodes.col(node).normalized();
        for (int c = 0; c < 2; ++c) row(node, c).push_back({columns_, Scalar(radial[c])});
        ++columns_;
      }
    }
    internal_ = columns_;
  }

  void follow_cuts() {
    const double angle = -2 * std::numbers::pi / sector_.sectors;
    Eigen::Matrix2d rotation;
    rotation << std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle);
    for (const std::array<int, 2>& pair : sector_.cyclic_pairs) {
      const Eigen::Vector2d left = sector_.mesh.nodes.col(pair[0]), right = sector_.mesh.nodes.col(pair[1]);
      if (!((rotation * left - right).norm() <= 1e-7 * right.norm()))
        refuse("sector.cyclic_pairs", std::to_string(pair[0]) + ", " + std::to_string(pair[1]),
               "must be a node of the left cut and its image on the right cut");
      for (int c = 0; c < 2; ++c)
        for (int d = 0; d < 2; ++d) append(row(pair[1], c), row(pair[0], d), phase_factor_ * rotation(c, d));
    }
  }

  void follow_flanks() {
    for (const Flank& flank : sector_.flanks) {
      const Eigen::Index first = columns_;
      columns_ += 2 * static_cast<Eigen::Index>(flank.corner_pairs.size());
      for (std::size_t k = 0; k < flank.corner_pairs.size(); ++k)
        follow(flank, flank.corner_pairs[k], first + 2 * static_cast<Eigen::Index>(k), 1.0);
      for (std::size_t k = 0; k < flank.middle_pairs.size(); ++k) {
        follow(flank, flank.middle_pairs[k], first + 2 * static_cast<Eigen::Index>(k), 0.5);
        add_relative(flank, flank.middle_pairs[k][0], first + 2 * static_cast<Eigen::Index>(k + 1), 0.5);
      }
    }
  }

  /// u_blade = u_disk + factor (n u_N + t u_T).
  void follow(const Flank& flank, const std::array<int, 2>& pair, Eigen::Index column, double factor) {
    for (int c = 0; c < 2; ++c) append(row(pair[0], c), row(pair[1], c), Scalar(1));
    add_relative(flank, pair[0], column, factor);
  }

  void add_relative(const Flank& flank, int node, Eigen::Index column, double factor) {
    for (int c = 0; c < 2; ++c) {
      row(node, c).push_back({column, Scalar(factor * flank.normal[c])});
      row(node, c).push_back({column + 1, Scalar(factor * flank.tangent[c])});
    }
  }

  static void append(Row& target, const Row& source, Scalar factor) {
    for (const Term& term : source) {
      const auto same =
          std::find_if(target.begin(), target.end(), [&](const Term& t) { return t.column == term.column; });
      if (same != target.end())
        same->factor += factor * term.factor;
      else
        target.push_back({term.column, factor * term.factor});
    }
  }

  const SectorMesh& sector_;
  BoreSupport bore_;
  Scalar phase_factor_;
  std::vector<Role> roles_;
  std::vector<Row> rows_;
  Eigen::Index columns_ = 0, internal_ = 0;
};

void check_diameter(const SectorMesh& sector, int nodal_diameter) {
  if (sector.sectors < 1) refuse("sector.sectors", std::to_string(sector.sectors), "must be >= 1");
  if (nodal_diameter < 0 || 2 * nodal_diameter > sector.sectors)
    refuse("nodal_diameter", std::to_string(nodal_diameter), "must be >= 0 and <= sectors/2");
}

}  // namespace

Constraints<double> real_constraints(const SectorMesh& sector, BoreSupport bore, int nodal_diameter) {
  check_diameter(sector, nodal_diameter);
  if (nodal_diameter != 0 && 2 * nodal_diameter != sector.sectors)
    refuse("nodal_diameter", std::to_string(nodal_diameter), "must be 0 or sectors/2 for a real transformation");
  return TransformationBuilder<double>(sector, bore, nodal_diameter == 0 ? 1.0 : -1.0).build();
}

Constraints<std::complex<double>> complex_constraints(const SectorMesh& sector, BoreSupport bore, int nodal_diameter) {
  check_diameter(sector, nodal_diameter);
  const double phase = 2 * std::numbers::pi * nodal_diameter / sector.sectors;
  return TransformationBuilder<std::complex<double>>(sector, bore, std::polar(1.0, phase)).build();
}

template <class Scalar>
Eigen::SparseMatrix<Scalar> constrain(const Eigen::SparseMatrix<double>& full, const Constraints<Scalar>& constraints) {
  using Sparse = Eigen::SparseMatrix<Scalar>;
  const Sparse& t = constraints.transformation;
  const Sparse at = full * t;
  const Sparse adjoint = t.adjoint();
  const Sparse product = adjoint * at;
  const Sparse transposed = product.adjoint();
  return Scalar(0.5) * (product + transposed);
}

template Eigen::SparseMatrix<double> constrain(const Eigen::SparseMatrix<double>&, const Constraints<double>&);
template Eigen::SparseMatrix<std::complex<double>> constrain(const Eigen::SparseMatrix<double>&,
                                                             const Constraints<std::complex<double>>&);

}  // namespace dovetail::fem
