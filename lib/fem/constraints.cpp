#include "fem/constraints.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "core/errors.hpp"
#include "fem/params.hpp"

namespace dovetail::fem {

namespace {

[[noreturn]] void refuse(const std::string& key, const std::string& value, const std::string& allowed) {
  throw InputError({.file = {}, .key = key, .value = value, .allowed = allowed});
}

/// What a node's displacement is made of, besides its supports.
enum class Role { free, right_cut, blade_flank };

/// Roles and supports of all nodes. Followers have the supports of the node they follow.
struct NodeRoles {
  std::vector<Role> role;
  std::vector<bool> bore, axial;

  NodeRoles(const SectorMesh& sector, BoreSupport support)
      : role(static_cast<std::size_t>(sector.mesh.node_count()), Role::free),
        bore(role.size(), false),
        axial(role.size(), false) {
    if (support != BoreSupport::free)
      for (int node : sector.bore_nodes) bore[index(node, "sector.bore_nodes")] = true;
    if (!sector.axial_nodes.empty() && sector.mesh.dimensions() != 3)
      refuse("sector.axial_nodes", std::to_string(sector.axial_nodes.size()), "must be empty in the plane");
    for (int node : sector.axial_nodes) axial[index(node, "sector.axial_nodes")] = true;
    for (const auto& [left, right] : sector.cyclic_pairs) {
      const std::size_t from = index(left, "sector.cyclic_pairs"), to = index(right, "sector.cyclic_pairs");
      if (bore[from] != bore[to] || axial[from] != axial[to])
        refuse("sector.cyclic_pairs", std::to_string(left) + ", " + std::to_string(right),
               "must be supported in the same way on both cuts");
      follow(to, Role::right_cut, "sector.cyclic_pairs");
    }
    for (const Flank& flank : sector.flanks)
      for (const auto& [blade, disk] : flank.pairs) {
        (void)index(disk, "sector.flanks.pairs");
        follow(index(blade, "sector.flanks.pairs"), Role::blade_flank, "sector.flanks.pairs");
      }
  }

 private:
  [[nodiscard]] std::size_t index(int node, const char* list) const {
    if (node < 0 || static_cast<std::size_t>(node) >= role.size())
      refuse(list, std::to_string(node), "must be an index of a node");
    return static_cast<std::size_t>(node);
  }
  void follow(std::size_t node, Role as, const char* list) {
    if (role[node] != Role::free) refuse(list, std::to_string(node), "must not be constrained twice");
    role[node] = as;
  }
};

void check(const Flank& flank, int dimensions) {
  constexpr MatchingParams kParams = {};
  const std::string key = "sector.flanks." + flank.name;
  const int count = flank.contact_count();
  if (flank.grid[0] < 2 || flank.grid[1] < 1)
    refuse(key + ".grid", std::to_string(flank.grid[0]) + " x " + std::to_string(flank.grid[1]),
           "must be at least 2 contact nodes along the flank and 1 along the slot");
  if (flank.position.rows() != dimensions || flank.position.cols() != count)
    refuse(key + ".position", std::to_string(flank.position.rows()) + " x " + std::to_string(flank.position.cols()),
           "must be one point per contact node");
  if (flank.interpolation.rows() != static_cast<Eigen::Index>(flank.pairs.size()) ||
      flank.interpolation.cols() != count)
    refuse(key + ".interpolation",
           std::to_string(flank.interpolation.rows()) + " x " + std::to_string(flank.interpolation.cols()),
           "must have a row per pair and a column per contact node");
  const Eigen::VectorXd sums = flank.interpolation * Eigen::VectorXd::Ones(count);
  if (!((sums.array() - 1).abs() <= kParams.weights).all()) refuse(key + ".interpolation", "rows", "must sum to 1");
  if (flank.normal.size() != dimensions || flank.tangents.rows() != dimensions ||
      flank.tangents.cols() != dimensions - 1)
    refuse(key + ".normal, tangents", std::to_string(flank.normal.size()), "must be as many as dimensions");
  Eigen::MatrixXd frame(dimensions, dimensions);
  frame << flank.normal, flank.tangents;
  if (!((frame.transpose() * frame - Eigen::MatrixXd::Identity(dimensions, dimensions)).norm() <= kParams.weights))
    refuse(key + ".normal, tangents", "frame", "must be orthonormal");
}

/// Collects the rows of T. Nodes that follow another one take its finished rows.
template <class Scalar>
class TransformationBuilder {
 public:
  TransformationBuilder(const SectorMesh& sector, BoreSupport bore, Scalar phase_factor)
      : sector_(sector), d_(sector.mesh.dimensions()), bore_(bore), phase_factor_(phase_factor), roles_(sector, bore) {
    for (const Flank& flank : sector.flanks) check(flank, d_);
    rows_.resize(static_cast<std::size_t>(d_) * roles_.role.size());
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

  Row& row(int node, int component) { return rows_[static_cast<std::size_t>(d_ * node + component)]; }

  void number_internal() {
    for (int node = 0; node < sector_.mesh.node_count(); ++node) {
      const std::size_t k = static_cast<std::size_t>(node);
      if (roles_.role[k] != Role::free) continue;
      if (!roles_.bore[k]) {
        for (int c = 0; c < 2; ++c) row(node, c).push_back({columns_++, Scalar(1)});
      } else if (bore_ == BoreSupport::tangential) {
        const Eigen::Vector2d radial = sector_.mesh.nodes.col(node).head<2>().normalized();
        for (int c = 0; c < 2; ++c) row(node, c).push_back({columns_, Scalar(radial[c])});
        ++columns_;
      }
      const bool held = roles_.axial[k] || (roles_.bore[k] && bore_ == BoreSupport::fixed);
      if (d_ == 3 && !held) row(node, 2).push_back({columns_++, Scalar(1)});
    }
    internal_ = columns_;
  }

  void follow_cuts() {
    const double angle = -2 * std::numbers::pi / sector_.sectors;
    Eigen::MatrixXd rotation = Eigen::MatrixXd::Identity(d_, d_);
    rotation.topLeftCorner<2, 2>() << std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle);
    for (const std::array<int, 2>& pair : sector_.cyclic_pairs) {
      const Eigen::VectorXd left = sector_.mesh.nodes.col(pair[0]), right = sector_.mesh.nodes.col(pair[1]);
      if (!((rotation * left - right).norm() <= MatchingParams{}.image * right.norm()))
        refuse("sector.cyclic_pairs", std::to_string(pair[0]) + ", " + std::to_string(pair[1]),
               "must be a node of the left cut and its image on the right cut");
      for (int c = 0; c < d_; ++c)
        for (int e = 0; e < d_; ++e)
          if (rotation(c, e) != 0) append(row(pair[1], c), row(pair[0], e), phase_factor_ * rotation(c, e));
    }
  }

  void follow_flanks() {
    for (const Flank& flank : sector_.flanks) {
      Eigen::MatrixXd frame(d_, d_);  // columns n, t1[, t2]
      frame << flank.normal, flank.tangents;
      const Eigen::SparseMatrix<double, Eigen::RowMajor> interpolation = flank.interpolation;
      for (std::size_t p = 0; p < flank.pairs.size(); ++p) {
        const auto& [blade, disk] = flank.pairs[p];
        for (int c = 0; c < d_; ++c) append(row(blade, c), row(disk, c), Scalar(1));
        for (Eigen::SparseMatrix<double, Eigen::RowMajor>::InnerIterator weight(interpolation,
                                                                                static_cast<Eigen::Index>(p));
             weight; ++weight)
          for (int c = 0; c < d_; ++c)
            for (int k = 0; k < d_; ++k)
              if (frame(c, k) != 0)
                row(blade, c).push_back({columns_ + d_ * weight.col() + k, Scalar(weight.value() * frame(c, k))});
      }
      columns_ += d_ * static_cast<Eigen::Index>(flank.contact_count());
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
  const int d_;
  BoreSupport bore_;
  Scalar phase_factor_;
  NodeRoles roles_;
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

}  // namespace dovetail::fem
