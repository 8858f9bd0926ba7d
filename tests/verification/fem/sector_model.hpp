#pragma once

#include "fem/sector_system.hpp"
#include "reduction/full_model.hpp"

namespace dovetail::fem::testing {

/// The unreduced model of a sector under its centrifugal load at `speed` (rad/s) and a tip force of 1 N.
inline reduction::FullModel sector_model(const SectorSystem& system, double speed, double friction) {
  const Eigen::Index d = system.full.dimensions, count = system.contact.count();
  reduction::FullModel full;
  Eigen::SparseMatrix<double> none = system.full.stiffness;
  none.coeffs().setZero();
  full.stiffness = constrain(stiffness_at_speed(system.full, none, speed), system.constraints);
  full.mass = system.mass;
  full.static_force = speed * speed * system.centrifugal;
  full.cosine_force = system.tip;
  full.sine_force = Eigen::MatrixXd::Zero(system.size(), 1);
  full.outputs = system.tip;
  full.output_names = {"tip_x"};
  full.contact.normal.resize(count);
  full.contact.tangential.resize(count, d - 1);
  for (Eigen::Index i = 0; i < count; ++i) {
    full.contact.normal(i) = static_cast<int>(system.internal_size() + d * i);
    for (Eigen::Index t = 0; t + 1 < d; ++t)
      full.contact.tangential(i, t) = full.contact.normal(i) + static_cast<int>(t) + 1;
  }
  full.contact.area = system.contact.area;
  full.contact.gap = system.contact.gap;
  full.contact.friction = Eigen::VectorXd::Constant(count, friction);
  full.contact.wear_coefficient = Eigen::VectorXd::Constant(count, 1e-13);
  full.contact.position = Eigen::MatrixX3d::Zero(count, 3);
  full.contact.position.leftCols(d) = system.contact.position.transpose();
  full.contact.group = system.contact.flank;
  full.contact.slip_origin = Eigen::MatrixXd::Zero(count, d - 1);
  return full;
}

}  // namespace dovetail::fem::testing
