#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <cmath>
#include <functional>
#include <numbers>
#include <random>
#include <stdexcept>
#include <vector>

#include "fem/sector_mesh.hpp"
#include "numerics/sparse_factor.hpp"

namespace dovetail::fem::testing {

/// A grid of `columns` x `rows` cells over (s, t) in the unit square, each cell two six-node triangles, mapped by an
/// orientation-preserving function to the plane. All grid points are mapped, so mid-sides lie on the true curves.
struct Grid {
  int columns, rows;
  Mesh mesh;
  /// Node at half-steps: 0 <= i <= 2 columns, 0 <= j <= 2 rows.
  [[nodiscard]] int node(int i, int j) const { return j * (2 * columns + 1) + i; }
};

using Map = std::function<Eigen::Vector2d(double s, double t)>;

inline Grid make_grid(int columns, int rows, const Map& map) {
  Grid grid{columns, rows, {}};
  grid.mesh.nodes.resize(2, (2 * columns + 1) * (2 * rows + 1));
  for (int j = 0; j <= 2 * rows; ++j)
    for (int i = 0; i <= 2 * columns; ++i)
      grid.mesh.nodes.col(grid.node(i, j)).head<2>() = map(0.5 * i / columns, 0.5 * j / rows);
  const auto at = [&](int i, int j) { return grid.node(i, j); };
  for (int j = 0; j < 2 * rows; j += 2)
    for (int i = 0; i < 2 * columns; i += 2) {
      for (int node : {at(i, j), at(i + 2, j), at(i + 2, j + 2), at(i + 1, j), at(i + 2, j + 1), at(i + 1, j + 1),  //
                       at(i, j), at(i + 2, j + 2), at(i, j + 2), at(i + 1, j + 1), at(i + 1, j + 2), at(i, j + 1)})
        grid.mesh.connectivity.push_back(node);
    }
  grid.mesh.region.assign(static_cast<std::size_t>(grid.mesh.element_count()), 0);
  grid.mesh.regions = {{.name = "body", .body = 0, .thickness = 1.0}};
  return grid;
}

inline Map rectangle(double width, double height, double x0 = 0, double y0 = 0) {
  return [=](double s, double t) { return Eigen::Vector2d(x0 + width * s, y0 + height * t); };
}

/// s runs outwards from the inner radius, t from the right cut to the left one (counter-clockwise).
inline Map annular_sector(double inner, double outer, int sectors) {
  return [=](double s, double t) {
    const double radius = inner + (outer - inner) * s;
    const double angle = std::numbers::pi / 2 + (2 * t - 1) * std::numbers::pi / sectors;
    return Eigen::Vector2d(radius * std::cos(angle), radius * std::sin(angle));
  };
}

/// Moves corner nodes off the boundary at random and puts mid-sides back between their corners.
inline void distort(Grid& grid, double amount, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> shift(-amount, amount);
  for (int j = 2; j < 2 * grid.rows; j += 2)
    for (int i = 2; i < 2 * grid.columns; i += 2)
      for (int c = 0; c < 2; ++c) grid.mesh.nodes(c, grid.node(i, j)) += shift(random);
  for (int i = 0; i < grid.mesh.element_count(); ++i) {
    const std::span<const int> e = grid.mesh.element(i);
    for (std::size_t k = 0; k < 3; ++k)
      grid.mesh.nodes.col(e[3 + k]) = 0.5 * (grid.mesh.nodes.col(e[k]) + grid.mesh.nodes.col(e[(k + 1) % 3]));
  }
}

/// Bends edges: moves mid-side nodes inside the grid at random.
inline void curve_edges(Grid& grid, double amount, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> shift(-amount, amount);
  for (int j = 1; j < 2 * grid.rows; ++j)
    for (int i = 1; i < 2 * grid.columns; ++i)
      if (i % 2 == 1 || j % 2 == 1)
        for (int c = 0; c < 2; ++c) grid.mesh.nodes(c, grid.node(i, j)) += shift(random);
}

/// Dofs of the nodes on the outline of the grid.
inline std::vector<int> outline_dofs(const Grid& grid) {
  std::vector<int> dofs;
  for (int j = 0; j <= 2 * grid.rows; ++j)
    for (int i = 0; i <= 2 * grid.columns; ++i)
      if (i == 0 || j == 0 || i == 2 * grid.columns || j == 2 * grid.rows)
        for (int c = 0; c < 2; ++c) dofs.push_back(2 * grid.node(i, j) + c);
  return dofs;
}

/// [n, free] selection of the dofs that are not held.
inline Eigen::SparseMatrix<double> free_selection(Eigen::Index dofs, const std::vector<int>& held) {
  std::vector<bool> is_held(static_cast<std::size_t>(dofs), false);
  for (int dof : held) is_held[static_cast<std::size_t>(dof)] = true;
  std::vector<Eigen::Triplet<double>> entries;
  int column = 0;
  for (int dof = 0; dof < dofs; ++dof)
    if (!is_held[static_cast<std::size_t>(dof)]) entries.emplace_back(dof, column++, 1.0);
  Eigen::SparseMatrix<double> selection(dofs, column);
  selection.setFromTriplets(entries.begin(), entries.end());
  return selection;
}

inline Eigen::SparseMatrix<double> restrict_to(const Eigen::SparseMatrix<double>& matrix,
                                               const Eigen::SparseMatrix<double>& selection) {
  const Eigen::SparseMatrix<double> right = matrix * selection;
  return selection.transpose() * right;
}

/// K u = f with u given on the held dofs (taken from `prescribed`).
inline Eigen::VectorXd solve_held(const Eigen::SparseMatrix<double>& stiffness, const Eigen::VectorXd& force,
                                  const std::vector<int>& held, const Eigen::VectorXd& prescribed) {
  const Eigen::SparseMatrix<double> selection = free_selection(stiffness.rows(), held);
  Eigen::VectorXd u = Eigen::VectorXd::Zero(stiffness.rows());
  for (int dof : held) u[dof] = prescribed[dof];
  const Eigen::VectorXd right = selection.transpose() * (force - stiffness * u);
  numerics::SparseCholesky<double> factor;
  if (factor.factorise(restrict_to(stiffness, selection)) != Status::converged) throw std::runtime_error("not held");
  return u + selection * factor.solve(right);
}

/// Sector of an annulus without a joint.
inline SectorMesh annulus_sector(const Grid& grid, int sectors) {
  SectorMesh sector;
  sector.mesh = grid.mesh;
  sector.sectors = sectors;
  for (int i = 0; i <= 2 * grid.columns; ++i)
    sector.cyclic_pairs.push_back({grid.node(i, 2 * grid.rows), grid.node(i, 0)});
  for (int j = 0; j <= 2 * grid.rows; ++j) sector.bore_nodes.push_back(grid.node(0, j));
  return sector;
}

/// A tooth (body 0) standing on an annular sector (body 1): radial cells `disk_cells` up to the flank, then
/// `tooth_cells` over the middle third of the sector. With `merged` false the tooth has its own nodes on the flank,
/// matched to the disk's; with true they are the same nodes and there is no flank.
inline SectorMesh toothed_sector(int disk_cells, int tooth_cells, int third, int sectors, bool merged) {
  const int columns = disk_cells + tooth_cells, rows = 3 * third;
  const double inner = 0.1, outer = 0.3, flank_radius = inner + (outer - inner) * disk_cells / columns;
  Grid grid = make_grid(columns, rows, annular_sector(inner, outer, sectors));
  SectorMesh sector;
  sector.sectors = sectors;
  std::vector<int> renumbered(static_cast<std::size_t>(grid.mesh.node_count()), -1);
  std::vector<int> tooth_copy(renumbered.size(), -1);
  std::vector<Eigen::Vector2d> nodes;
  const int first = 2 * third, last = 4 * third;
  for (int j = 0; j <= 2 * rows; ++j)
    for (int i = 0; i <= 2 * columns; ++i) {
      const bool on_flank = i == 2 * disk_cells && j >= first && j <= last;
      if (i > 2 * disk_cells && (j < first || j > last)) continue;
      const std::size_t old = static_cast<std::size_t>(grid.node(i, j));
      renumbered[old] = static_cast<int>(nodes.size());
      nodes.push_back(grid.mesh.nodes.col(grid.node(i, j)));
      if (on_flank && !merged) {
        tooth_copy[old] = static_cast<int>(nodes.size());
        nodes.push_back(grid.mesh.nodes.col(grid.node(i, j)));
      }
    }
  sector.mesh.nodes.resize(2, static_cast<Eigen::Index>(nodes.size()));
  for (std::size_t k = 0; k < nodes.size(); ++k)
    sector.mesh.nodes.col(static_cast<Eigen::Index>(k)).head<2>() = nodes[k];
  for (int e = 0; e < grid.mesh.element_count(); ++e) {
    const int cell = e / 2, radial = cell % columns, angular = cell / columns;
    const bool tooth = radial >= disk_cells;
    if (tooth && (angular < third || angular >= 2 * third)) continue;
    for (int node : grid.mesh.element(e)) {
      const std::size_t old = static_cast<std::size_t>(node);
      sector.mesh.connectivity.push_back(tooth && tooth_copy[old] >= 0 ? tooth_copy[old] : renumbered[old]);
    }
    sector.mesh.region.push_back(tooth ? 0 : 1);
  }
  sector.mesh.regions = {{.name = "tooth", .body = 0, .thickness = 0.02},
                         {.name = "disk", .body = 1, .thickness = 0.03}};
  const auto number = [&](int i, int j) { return renumbered[static_cast<std::size_t>(grid.node(i, j))]; };
  for (int i = 0; i <= 2 * disk_cells; ++i) sector.cyclic_pairs.push_back({number(i, 2 * rows), number(i, 0)});
  for (int j = 0; j <= 2 * rows; ++j) sector.bore_nodes.push_back(number(0, j));
  sector.tip_node = number(2 * columns, rows % 2 == 0 ? rows : rows - 1);
  // A straight flank with mid-sides in the middle: the linear contact interpolation is meant for one.
  for (int pass = 0; pass < 2; ++pass)
    for (int j = first + pass; j <= last; j += 2) {
      const std::size_t old = static_cast<std::size_t>(grid.node(2 * disk_cells, j));
      Eigen::Vector2d place = sector.mesh.nodes.col(renumbered[old]);
      if (pass == 1)
        place = 0.5 * (sector.mesh.nodes.col(number(2 * disk_cells, j - 1)) +
                       sector.mesh.nodes.col(number(2 * disk_cells, j + 1)));
      place.y() = flank_radius;
      sector.mesh.nodes.col(renumbered[old]).head<2>() = place;
      if (tooth_copy[old] >= 0) sector.mesh.nodes.col(tooth_copy[old]).head<2>() = place;
    }
  if (merged) return sector;
  Flank flank;
  flank.name = "foot";
  flank.normal = Eigen::Vector2d(0, -1);
  flank.tangents = Eigen::Vector2d(1, 0);
  flank.grid = {third + 1, 1};
  flank.position.resize(2, third + 1);
  flank.interpolation.resize(2 * third + 1, third + 1);
  for (int k = 0; k <= last - first; ++k) {
    const int disk = number(2 * disk_cells, last - k);
    const int blade = tooth_copy[static_cast<std::size_t>(grid.node(2 * disk_cells, last - k))];
    flank.pairs.push_back({blade, disk});
    if (k % 2 == 0) flank.position.col(k / 2) = sector.mesh.nodes.col(blade);
    for (int i : {k / 2, (k + 1) / 2}) flank.interpolation.coeffRef(k, i) += 0.5;
  }
  flank.gap = Eigen::VectorXd::Zero(third + 1);
  sector.flanks.push_back(flank);
  return sector;
}

}  // namespace dovetail::fem::testing
