#pragma once

#include <Eigen/Core>
#include <random>
#include <vector>

#include "reduction/full_model.hpp"

namespace dovetail::reduction {

/// A plane truss "blade" that stands on a truss "disk" and is held by contact only. Unit spacing, random
/// spring stiffnesses and masses: no symmetry hides an error, and the blade's three rigid motions are exact.
struct TrussSettings {
  int columns = 4;  ///< contact nodes
  int blade_rows = 4, disk_rows = 3;
  double speed = 0;          ///< rad/s, K - speed^2 M
  bool contact_mass = true;  ///< false: the blade's contact nodes carry no mass
  unsigned seed = 7;
};

inline FullModel truss_model(const TrussSettings& settings = {}) {
  std::mt19937 random(settings.seed);
  std::uniform_real_distribution<double> spread(0.7, 1.3);
  const int columns = settings.columns;
  const int disk_nodes = columns * settings.disk_rows;
  const int nodes = disk_nodes + columns * settings.blade_rows;
  std::vector<Eigen::Triplet<double>> stiffness, mass, transform;
  const auto node_of = [&](int body, int row, int column) {
    return (body == 0 ? 0 : disk_nodes) + row * columns + column;
  };
  const auto spring = [&](int a, int b, const Eigen::Vector2d& axis) {
    const Eigen::Matrix2d block = 1e6 * spread(random) * axis.normalized() * axis.normalized().transpose();
    for (int i = 0; i < 2; ++i)
      for (int j = 0; j < 2; ++j) {
        stiffness.emplace_back(2 * a + i, 2 * a + j, block(i, j));
        if (b < 0) continue;
        stiffness.emplace_back(2 * b + i, 2 * b + j, block(i, j));
        stiffness.emplace_back(2 * a + i, 2 * b + j, -block(i, j));
        stiffness.emplace_back(2 * b + i, 2 * a + j, -block(i, j));
      }
  };
  for (int body = 0; body < 2; ++body) {
    const int rows = body == 0 ? settings.disk_rows : settings.blade_rows;
    for (int row = 0; row < rows; ++row)
      for (int column = 0; column < columns; ++column) {
        const int here = node_of(body, row, column);
        if (column + 1 < columns) spring(here, node_of(body, row, column + 1), {1, 0});
        if (row + 1 < rows) spring(here, node_of(body, row + 1, column), {0, 1});
        if (row + 1 < rows && column + 1 < columns) {
          spring(here, node_of(body, row + 1, column + 1), {1, 1});
          spring(node_of(body, row, column + 1), node_of(body, row + 1, column), {-1, 1});
        }
        if (body == 0 && row == 0) {
          spring(here, -1, {1, 0});
          spring(here, -1, {0, 1});
        }
        const bool on_contact = body == 1 && row == 0;
        const double m = settings.contact_mass || !on_contact ? spread(random) : 0.0;
        for (int i = 0; i < 2; ++i) mass.emplace_back(2 * here + i, 2 * here + i, m);
      }
  }
  // Coordinates: disk, blade without its bottom row, then r_N = -(v_blade - v_disk), r_T = u_blade - u_disk.
  const int contact = 2 * columns;
  const int n = 2 * nodes;
  const int internal = n - contact;
  for (int node = 0; node < disk_nodes; ++node)
    for (int i = 0; i < 2; ++i) transform.emplace_back(2 * node + i, 2 * node + i, 1.0);
  for (int node = disk_nodes + columns; node < nodes; ++node)
    for (int i = 0; i < 2; ++i) transform.emplace_back(2 * node + i, 2 * (node - columns) + i, 1.0);
  for (int column = 0; column < columns; ++column) {
    const int blade = node_of(1, 0, column), disk = node_of(0, settings.disk_rows - 1, column);
    for (int i = 0; i < 2; ++i) transform.emplace_back(2 * blade + i, 2 * disk + i, 1.0);
    transform.emplace_back(2 * blade + 1, internal + 2 * column, -1.0);
    transform.emplace_back(2 * blade, internal + 2 * column + 1, 1.0);
  }
  Eigen::SparseMatrix<double> k(n, n), m(n, n), t(n, n);
  k.setFromTriplets(stiffness.begin(), stiffness.end());
  m.setFromTriplets(mass.begin(), mass.end());
  t.setFromTriplets(transform.begin(), transform.end());
  k = Eigen::SparseMatrix<double>(k - settings.speed * settings.speed * m);

  FullModel model;
  model.stiffness = Eigen::SparseMatrix<double>(t.transpose()) * k * t;
  model.mass = Eigen::SparseMatrix<double>(t.transpose()) * m * t;
  const int tip = nodes - columns / 2 - 1;
  Eigen::VectorXd tip_force = Eigen::VectorXd::Zero(n);
  tip_force(2 * tip) = 1;
  Eigen::VectorXd pull = Eigen::VectorXd::Zero(n);
  for (int node = disk_nodes; node < nodes; ++node) {
    pull(2 * node) = 0.3;
    pull(2 * node + 1) = -5;
  }
  model.static_force = t.transpose() * pull;
  model.cosine_force = t.transpose() * tip_force;
  model.sine_force = Eigen::MatrixXd::Zero(n, 1);
  model.outputs.resize(n, 2);
  Eigen::VectorXd other = Eigen::VectorXd::Zero(n);
  other(2 * tip + 1) = 1;
  model.outputs << t.transpose() * tip_force, t.transpose() * other;
  model.output_names = {"tip", "tip_radial"};
  model.contact.normal.resize(columns);
  model.contact.tangential.resize(columns, 1);
  for (int column = 0; column < columns; ++column) {
    model.contact.normal(column) = internal + 2 * column;
    model.contact.tangential(column, 0) = internal + 2 * column + 1;
  }
  model.contact.area = Eigen::VectorXd::Constant(columns, 1e-4);
  model.contact.gap = Eigen::VectorXd::Zero(columns);
  model.contact.friction = Eigen::VectorXd::Constant(columns, 0.5);
  model.contact.wear_coefficient = Eigen::VectorXd::Constant(columns, 1e-13);
  model.contact.slip_origin = Eigen::MatrixXd::Zero(columns, 1);
  return model;
}

}  // namespace dovetail::reduction
