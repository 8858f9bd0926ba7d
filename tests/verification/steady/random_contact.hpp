#pragma once

#include <Eigen/LU>
#include <cmath>
#include <complex>
#include <random>

#include "tests/verification/steady/rod.hpp"

namespace dovetail::verification {

/// A small random structure on massless contact nodes, and a frequency near a resonance of it.
struct RandomContact {
  reduction::ReducedModel model;
  double omega = 0;  ///< rad/s
  bool gaps = false;
};

/// Case `seed`: 1-8 nodes with 1 or 2 tangential directions; 2-5 modes of damping ratio 0.5-5 % between 1 and 3 rad/s;
/// contact springs coupled in all directions; friction 0.1-0.8. The static normal load is scaled so that in the
/// glued structure tangential forces reach 0.8-4 times the limit of friction somewhere; a third of the cases swing the
/// normal force as strongly as that, so that nodes lift off, and a third has gaps and interferences.
inline RandomContact random_contact(unsigned seed) {
  std::mt19937_64 engine(seed);
  const auto uniform = [&](double a, double b) {
    return a + (b - a) * (static_cast<double>(engine() >> 11) * 0x1p-53);
  };
  const auto whole = [&](int a, int b) { return a + static_cast<int>(uniform(0, 1) * (b - a + 1)); };
  const auto random = [&](Eigen::Index rows, Eigen::Index columns) {
    return Eigen::MatrixXd(Eigen::MatrixXd::NullaryExpr(rows, columns, [&] { return uniform(-1, 1); }));
  };
  RandomContact result;
  const int nodes = whole(1, 3) == 1 ? whole(4, 8) : whole(1, 3);
  const int directions = whole(2, 3), modes = whole(2, 5);
  const int nc = nodes * directions;
  const bool lifting = whole(1, 3) == 1;
  result.gaps = whole(1, 3) == 1;
  result.model = empty_model(nc + modes, nodes, directions - 1);
  reduction::ReducedModel& model = result.model;

  // A spring behind each node, its other end on the modes.
  Eigen::MatrixXd shape = random(nc, modes), spring = Eigen::MatrixXd::Zero(nc, nc);
  for (int i = 0; i < nodes; ++i) {
    const Eigen::MatrixXd r = random(directions, directions);
    const double stiff = std::pow(10, uniform(-0.5, 1));
    spring.block(i * directions, i * directions, directions, directions) =
        stiff * (0.3 * r * r.transpose() + Eigen::MatrixXd::Identity(directions, directions));
    shape.row(i * directions) *= lifting ? 1.0 : 0.15;
  }
  shape /= std::sqrt(static_cast<double>(nodes));
  for (int j = 0; j < modes; ++j) {
    const double free = j == 0 ? 1 : uniform(1.2, 3);
    model.mass(nc + j, nc + j) = 1;
    model.stiffness(nc + j, nc + j) = free * free;
    model.damping(nc + j, nc + j) = 2 * uniform(0.005, 0.05) * free;
  }
  model.stiffness.topLeftCorner(nc, nc) = spring;
  model.stiffness.topRightCorner(nc, modes) = -spring * shape;
  model.stiffness.bottomLeftCorner(modes, nc) = -shape.transpose() * spring;
  model.stiffness.bottomRightCorner(modes, modes) += shape.transpose() * spring * shape;

  for (int i = 0; i < nodes; ++i) {
    model.contact.normal(i) = i * directions;
    for (int r = 1; r < directions; ++r) model.contact.tangential(i, r - 1) = i * directions + r;
    model.contact.friction(i) = uniform(0.1, 0.8);
    model.contact.wear_coefficient(i) = 1e-3;
  }
  model.cosine_force.row(0).tail(modes) = random(1, modes);
  model.sine_force.row(0).tail(modes) = random(1, modes);
  model.output_vectors = Eigen::MatrixXd::Zero(1, nc + modes);
  model.output_vectors.row(0).tail(modes) = random(1, modes);
  model.output_names = {"output"};

  const auto glued = [&](double omega) {
    const std::complex<double> s(0, omega);
    const Eigen::MatrixXcd dynamic = model.stiffness.bottomRightCorner(modes, modes).cast<std::complex<double>>() +
                                     s * model.damping.bottomRightCorner(modes, modes) -
                                     omega * omega * model.mass.bottomRightCorner(modes, modes);
    Eigen::VectorXcd force(modes);
    force.real() = model.cosine_force.row(0).tail(modes).transpose();
    force.imag() = -model.sine_force.row(0).tail(modes).transpose();
    return Eigen::VectorXcd(dynamic.lu().solve(force));
  };
  const double lowest = condensed(model)->glued_frequencies()(0);
  result.omega = lowest * uniform(0.7, 1.1);
  const Eigen::VectorXcd contact_force = spring * (shape * glued(result.omega)).eval();
  const double reach = uniform(0.8, 4);
  double normal = 0;
  for (int i = 0; i < nodes; ++i)
    normal = std::max(
        normal, contact_force.segment(i * directions + 1, directions - 1).norm() / model.contact.friction(i) / reach);
  for (int i = 0; i < nodes; ++i) {
    model.static_force(i * directions) = normal * uniform(0.5, 1.5);
    if (result.gaps) model.contact.gap(i) = uniform(-0.3, 0.6) * normal / spring(i * directions, i * directions);
  }
  return result;
}

}  // namespace dovetail::verification
