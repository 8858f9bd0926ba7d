#include "geometry/solid/morph_weights.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <cassert>
#include <cmath>
#include <limits>
#include <vector>

#include "geometry/mesh/index.hpp"

namespace dovetail::geometry {
namespace {

using Eigen::Vector2d;

/// In place of values that are to be found.
constexpr double kFree = std::numeric_limits<double>::quiet_NaN();

/// 0 where the sweep of the root holds.
std::vector<double> held_root(const CornerMesh& mesh, const Chain& chain) {
  std::vector<double> value(mesh.nodes.size(), kFree);
  // The boundary's own nodes lie on this level up to rounding.
  const double neck = edge(chain, "neck_right").end.y() + 1e-12;
  for (std::size_t i = 0; i < mesh.nodes.size(); ++i)
    if (mesh.nodes[i].y() <= neck) value[i] = 0;
  for (std::size_t e = 0; e < chain.size(); ++e)
    if (chain[e].name.starts_with("platform_side"))
      for (const int node : mesh.edge_nodes[e]) value[index(node)] = 0;
  return value;
}

std::vector<double> held_chord(const CornerMesh& mesh, const Chain& chain) {
  std::vector<double> value = held_root(mesh, chain);
  const double side = edge(chain, "platform_side_right").start.x();
  const double foot = edge(chain, "platform_top_right").end.x();
  for (std::size_t e = 0; e < chain.size(); ++e)
    if (chain[e].name.starts_with("platform_top") || chain[e].name.starts_with("platform_bottom"))
      for (const int node : mesh.edge_nodes[e])
        value[index(node)] = (side - std::abs(mesh.nodes[index(node)].x())) / (side - foot);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    if (mesh.region[t] == 1)
      for (const int node : mesh.triangles[t]) value[index(node)] = 1;
  return value;
}

std::vector<double> held_thickness(const CornerMesh& mesh, const Chain& chain) {
  std::vector<double> value = held_root(mesh, chain);
  const double half = edge(chain, "aerofoil_right").start.x();
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    if (mesh.region[t] == 1)
      for (const int node : mesh.triangles[t]) value[index(node)] = mesh.nodes[index(node)].x() / half;
  return value;
}

/// Continues given values into the nodes whose value is NaN.
Eigen::VectorXd continued(const CornerMesh& mesh, const std::vector<double>& value) {
  std::vector<int> place(value.size(), -1);
  int free = 0;
  for (std::size_t i = 0; i < value.size(); ++i)
    if (std::isnan(value[i])) place[i] = free++;

  std::vector<Eigen::Triplet<double>> entries;
  Eigen::VectorXd load = Eigen::VectorXd::Zero(free);
  for (const auto& triangle : mesh.triangles) {
    const Vector2d &a = mesh.nodes[index(triangle[0])], &b = mesh.nodes[index(triangle[1])],
                   &c = mesh.nodes[index(triangle[2])];
    Eigen::Matrix2d jacobian;
    jacobian << b - a, c - a;
    Eigen::Matrix<double, 3, 2> local;
    local << -1, -1, 1, 0, 0, 1;
    const Eigen::Matrix<double, 3, 2> gradient = local * jacobian.inverse();
    const Eigen::Matrix3d conduction = gradient * gradient.transpose();  // area times 1/area
    for (int i = 0; i < 3; ++i) {
      const int row = place[index(triangle[index(i)])];
      if (row < 0) continue;
      for (int j = 0; j < 3; ++j) {
        const std::size_t node = index(triangle[index(j)]);
        if (place[node] >= 0)
          entries.emplace_back(row, place[node], conduction(i, j));
        else
          load[row] -= conduction(i, j) * value[node];
      }
    }
  }
  Eigen::SparseMatrix<double> matrix(free, free);
  matrix.setFromTriplets(entries.begin(), entries.end());
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor(matrix);
  assert(factor.info() == Eigen::Success);
  const Eigen::VectorXd solution = factor.solve(load);

  Eigen::VectorXd weights(static_cast<Eigen::Index>(value.size()));
  for (std::size_t i = 0; i < value.size(); ++i)
    weights[static_cast<Eigen::Index>(i)] = place[i] >= 0 ? solution[place[i]] : value[i];
  return weights;
}

}  // namespace

MorphWeights morph_weights(const CornerMesh& mesh, const Chain& reference) {
  return {.chord = continued(mesh, held_chord(mesh, reference)),
          .thickness = continued(mesh, held_thickness(mesh, reference))};
}

}  // namespace dovetail::geometry
