#pragma once

#include "tests/verification/steady/rod.hpp"

namespace dovetail::verification {

/// m = 1 on a spring 1 with damping 2 zeta, whose displacement x a spring 1 carries to a massless frictionless contact
/// node: contact closes at x = gap. Piecewise linear: stiffness 1 for x < gap, 2 above it (gap > 0: hardening;
/// interference gap < 0: contact lost below x = gap, softening). Excited by force cos; x is the output. Dofs x, u_N,
/// u_T.
inline reduction::ReducedModel gap_oscillator(double gap, double zeta, double force) {
  reduction::ReducedModel model = empty_model(3, 1, 1);
  model.mass(0, 0) = 1;
  model.damping(0, 0) = 2 * zeta;
  model.stiffness(0, 0) = 2;
  model.stiffness(1, 1) = model.stiffness(2, 2) = 1;
  model.stiffness(0, 1) = model.stiffness(1, 0) = -1;
  model.contact.normal << 1;
  model.contact.tangential << 2;
  model.contact.gap << gap;
  model.cosine_force(0, 0) = force;
  model.output_vectors = Eigen::MatrixXd::Zero(1, 3);
  model.output_vectors(0, 0) = 1;
  model.output_names = {"x"};
  return model;
}

}  // namespace dovetail::verification
