#include "geometry/mesh/elastic_motion.hpp"

#include <Eigen/LU>
#include <cassert>

#include "geometry/mesh/params.hpp"

namespace dovetail::geometry {
namespace {

using Stiffness = Eigen::Matrix<double, 6, 6>;

/// `area E B^T C B` with E = 1/area: the area drops out.
Stiffness stiffness(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c) {
  constexpr double kPoisson = MotionParams{}.poisson;
  Eigen::Matrix2d jacobian;
  jacobian << b - a, c - a;
  Eigen::Matrix<double, 3, 2> local;
  local << -1, -1, 1, 0, 0, 1;
  const Eigen::Matrix<double, 3, 2> gradient = local * jacobian.inverse();
  Eigen::Matrix<double, 3, 6> strain;
  for (int i = 0; i < 3; ++i) {
    const double dx = gradient(i, 0), dy = gradient(i, 1);
    strain.middleCols<2>(2 * i) << dx, 0, 0, dy, dy, dx;
  }
  Eigen::Matrix3d law;
  law << 1 - kPoisson, kPoisson, 0, kPoisson, 1 - kPoisson, 0, 0, 0, (1 - 2 * kPoisson) / 2;
  return strain.transpose() * law * strain / ((1 + kPoisson) * (1 - 2 * kPoisson));
}

}  // namespace

ElasticMotion::ElasticMotion(const CornerMesh& reference, const std::vector<int>& prescribed)
    : reference_(2, static_cast<Eigen::Index>(reference.nodes.size())), prescribed_(prescribed) {
  const int count = static_cast<int>(reference.nodes.size());
  for (int i = 0; i < count; ++i) reference_.col(i) = reference.nodes[static_cast<std::size_t>(i)];

  std::vector<int> place(reference.nodes.size(), -1);  // >= 0: free; < 0: -1 - position among the prescribed
  for (std::size_t k = 0; k < prescribed.size(); ++k)
    place[static_cast<std::size_t>(prescribed[k])] = -1 - static_cast<int>(k);
  std::vector<bool> fixed(reference.nodes.size(), false);
  for (int i : prescribed) fixed[static_cast<std::size_t>(i)] = true;
  for (int i = 0; i < count; ++i)
    if (!fixed[static_cast<std::size_t>(i)]) {
      place[static_cast<std::size_t>(i)] = static_cast<int>(free_.size());
      free_.push_back(i);
    }

  std::vector<Eigen::Triplet<double>> inner, coupling;
  for (const auto& triangle : reference.triangles) {
    const Stiffness k =
        stiffness(reference_.col(triangle[0]), reference_.col(triangle[1]), reference_.col(triangle[2]));
    for (int i = 0; i < 6; ++i) {
      const int row = place[static_cast<std::size_t>(triangle[static_cast<std::size_t>(i / 2)])];
      if (row < 0) continue;
      for (int j = 0; j < 6; ++j) {
        const int column = place[static_cast<std::size_t>(triangle[static_cast<std::size_t>(j / 2)])];
        if (column >= 0)
          inner.emplace_back(2 * row + i % 2, 2 * column + j % 2, k(i, j));
        else
          coupling.emplace_back(2 * row + i % 2, 2 * (-1 - column) + j % 2, k(i, j));
      }
    }
  }
  const Eigen::Index free_size = 2 * static_cast<Eigen::Index>(free_.size());
  Eigen::SparseMatrix<double> matrix(free_size, free_size);
  matrix.setFromTriplets(inner.begin(), inner.end());
  coupling_.resize(free_size, 2 * static_cast<Eigen::Index>(prescribed_.size()));
  coupling_.setFromTriplets(coupling.begin(), coupling.end());
  factor_.compute(matrix);
  assert(factor_.info() == Eigen::Success);
}

Eigen::Matrix2Xd ElasticMotion::positions(const Eigen::Matrix2Xd& prescribed_positions) const {
  Eigen::Matrix2Xd moved(2, prescribed_positions.cols());
  for (std::size_t k = 0; k < prescribed_.size(); ++k) {
    const Eigen::Index column = static_cast<Eigen::Index>(k);
    moved.col(column) = prescribed_positions.col(column) - reference_.col(prescribed_[k]);
  }
  const Eigen::VectorXd load = -(coupling_ * moved.reshaped());
  const Eigen::VectorXd inner = factor_.solve(load);
  Eigen::Matrix2Xd result = reference_;
  for (std::size_t k = 0; k < free_.size(); ++k)
    result.col(free_[k]) += inner.segment<2>(2 * static_cast<Eigen::Index>(k));
  for (std::size_t k = 0; k < prescribed_.size(); ++k)
    result.col(prescribed_[k]) = prescribed_positions.col(static_cast<Eigen::Index>(k));
  return result;
}

}  // namespace dovetail::geometry
