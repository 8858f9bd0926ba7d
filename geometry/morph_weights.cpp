#include "geometry/morph_weights.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <cassert>
#include <vector>

namespace dovetail::geometry {
namespace {

using Eigen::Vector2d;

std::size_t index(int i) {
  return static_cast<std::size_t>(i);
}

/// 1, 0, or -1 where the weight is to be found.
std::vector<int> held(const CornerMesh& mesh, const Chain& chain) {
  std::vector<int> value(mesh.nodes.size(), -1);
  const double neck = edge(chain, "neck_right").end.y();
  // The boundary's own nodes lie on this level up to rounding.
  constexpr double kRounding = 1e-12;
  for (std::size_t i = 0; i < mesh.nodes.size(); ++i)
    if (mesh.nodes[i].y() <= neck + kRounding) value[i] = 0;
  for (std::size_t e = 0; e < chain.size(); ++e)
    if (chain[e].name.starts_with("platform_side"))
      for (int node : mesh.edge_nodes[e]) value[index(node)] = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    if (mesh.region[t] == 1)
      for (int node : mesh.triangles[t]) value[index(node)] = 1;
  return value;
}

}  // namespace

Eigen::VectorXd morph_weights(const CornerMesh& mesh, const Chain& reference) {
  const std::vector<int> value = held(mesh, reference);
  std::vector<int> place(value.size(), -1);
  int free = 0;
  for (std::size_t i = 0; i < value.size(); ++i)
    if (value[i] < 0) place[i] = free++;

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
      const int row = place[index(triangle[static_cast<std::size_t>(i)])];
      if (row < 0) continue;
      for (int j = 0; j < 3; ++j) {
        const std::size_t node = index(triangle[static_cast<std::size_t>(j)]);
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
  // Obtuse triangles may overstep the bounds a little.
  return weights.cwiseMax(0.0).cwiseMin(1.0);
}

}  // namespace dovetail::geometry
