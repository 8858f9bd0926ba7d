#pragma once

#include <cmath>
#include <memory>

#include "dynamics/condensed_model.hpp"
#include "reduction/reduced_model.hpp"

namespace dovetail::verification {

/// Empty contact tables for `nodes` nodes with `tangential` directions in a model of n dofs.
inline reduction::ReducedModel empty_model(Eigen::Index n, Eigen::Index nodes, Eigen::Index tangential) {
  reduction::ReducedModel model;
  model.mass = model.damping = model.stiffness = Eigen::MatrixXd::Zero(n, n);
  model.static_force = Eigen::VectorXd::Zero(n);
  model.cosine_force = model.sine_force = Eigen::MatrixXd::Zero(1, n);
  model.contact.normal.resize(nodes);
  model.contact.tangential.resize(nodes, tangential);
  model.contact.area = Eigen::VectorXd::Ones(nodes);
  model.contact.gap = Eigen::VectorXd::Zero(nodes);
  model.contact.friction = Eigen::VectorXd::Zero(nodes);
  model.contact.wear_coefficient = Eigen::VectorXd::Zero(nodes);
  model.contact.slip_origin = Eigen::MatrixXd::Zero(nodes, tangential);
  return model;
}

/// A rod of N masses on springs, k = N tridiag(-1, 2, -1) with k(N, N) = N, M = I / N, C = 0.04 M; behind a spring
/// 10 / N at each mass a massless contact node with limit force 1 / N: normal force 1 and mu = 1 / N. Excited by
/// 0.3 cos at the tip, which is the output. Dofs: masses, then tangential, then normal contact displacements.
inline reduction::ReducedModel rod(int count) {
  const Eigen::Index n = count;
  const double N = count;
  reduction::ReducedModel model = empty_model(3 * n, n, 1);
  for (Eigen::Index i = 0; i < n; ++i) {
    model.mass(i, i) = 1 / N;
    model.damping(i, i) = 0.04 / N;
    model.stiffness(i, i) = (i == n - 1 ? N : 2 * N) + 10 / N;
    if (i > 0) model.stiffness(i, i - 1) = model.stiffness(i - 1, i) = -N;
    model.stiffness(n + i, n + i) = 10 / N;
    model.stiffness(i, n + i) = model.stiffness(n + i, i) = -10 / N;
    model.stiffness(2 * n + i, 2 * n + i) = 1;
    model.static_force(2 * n + i) = 1;
    model.contact.normal(i) = static_cast<int>(2 * n + i);
    model.contact.tangential(i, 0) = static_cast<int>(n + i);
  }
  model.contact.friction.setConstant(1 / N);
  model.contact.wear_coefficient.setConstant(1e-3);
  model.cosine_force(0, n - 1) = 0.3;
  model.output_vectors = Eigen::MatrixXd::Zero(1, 3 * n);
  model.output_vectors(0, n - 1) = 1;
  model.output_names = {"tip"};
  return model;
}

/// One massless node (N, T1, T2) behind a spring on a mass of three directions: the case with normal load and friction
/// coupled in space of which the friction energy is known to 2e-8.
inline reduction::ReducedModel single_node() {
  reduction::ReducedModel model = empty_model(6, 1, 2);
  // Mass dofs x, y, z are 0, 1, 2 (z opening); contact T1, T2 follow x, y, and the closing N is -z: 3, 4, 5.
  Eigen::Matrix3d structure;
  structure << 1, .1, .15, .1, 1.3, .05, .15, .05, .8;
  const Eigen::Vector3d spring(2, 1.5, 3);
  model.mass.topLeftCorner<3, 3>().setIdentity();
  model.damping.topLeftCorner<3, 3>() = 0.05 * Eigen::Matrix3d::Identity() + 0.02 * structure;
  model.stiffness.topLeftCorner<3, 3>() = structure;
  for (int r = 0; r < 3; ++r) {
    const double sign = r == 2 ? -1 : 1;
    model.stiffness(r, r) += spring(r);
    model.stiffness(3 + r, 3 + r) = spring(r);
    model.stiffness(r, 3 + r) = model.stiffness(3 + r, r) = -sign * spring(r);
  }
  model.contact.tangential << 3, 4;
  model.contact.normal << 5;
  model.contact.friction << 0.4;
  model.contact.wear_coefficient << 1e-3;
  model.static_force(2) = -2;
  model.cosine_force(0, 0) = 1.2;
  model.sine_force(0, 1) = 0.9;
  model.cosine_force(0, 2) = 0.3;
  model.sine_force(0, 2) = 0.2;
  model.output_vectors = Eigen::MatrixXd::Identity(3, 6);
  model.output_names = {"x", "y", "z"};
  return model;
}

/// m = k = 1 under cos, on rigid Coulomb friction of limit force x_f with mass on the contact [Den Hartog 1931].
inline reduction::ReducedModel den_hartog(double limit) {
  reduction::ReducedModel model = empty_model(2, 1, 1);
  model.mass(0, 0) = model.stiffness(0, 0) = model.stiffness(1, 1) = 1;
  model.contact.tangential << 0;
  model.contact.normal << 1;
  model.contact.friction << limit;
  model.static_force(1) = 1;
  model.cosine_force(0, 0) = 1;
  model.output_vectors = Eigen::MatrixXd::Identity(1, 2);
  model.output_names = {"x"};
  return model;
}

inline std::shared_ptr<const dynamics::CondensedModel> condensed(const reduction::ReducedModel& model) {
  return std::make_shared<const dynamics::CondensedModel>(model);
}

}  // namespace dovetail::verification
