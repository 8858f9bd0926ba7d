#include "dynamics/harmonic_system.hpp"

#include "dynamics/real_block.hpp"

namespace dovetail::dynamics {

HarmonicSystem harmonic_system(const CondensedModel& model, int harmonics, double omega, double static_scale) {
  HarmonicSystem system;
  system.omega = omega;
  system.force.resize(model.contact_size(), 2 * harmonics + 1);
  for (int h = 0; h <= harmonics; ++h) {
    system.harmonics.push_back(model.harmonic(h, omega, static_scale));
    const CondensedHarmonic& at = system.harmonics.back();
    if (at.status != Status::converged) system.status = at.status;
    if (!at.force.allFinite()) system.status = Status::not_finite;
    put_harmonic(at.force, h, system.force);
  }
  system.stiffness = model.stiffness(omega, system.harmonics);
  if (!system.stiffness.all_finite()) system.status = Status::not_finite;
  system.force_scale = system.force.rightCols(2 * harmonics).norm();
  if (!(system.force_scale > 0)) system.force_scale = system.force.norm();
  if (!(system.force_scale > 0)) system.force_scale = 1;
  return system;
}

Eigen::MatrixXd apply_stiffness(const HarmonicSystem& system, const Eigen::MatrixXd& displacement) {
  return system.stiffness.apply(displacement.reshaped()).reshaped(displacement.rows(), displacement.cols());
}

Eigen::MatrixXd apply_slope(const CondensedModel& model, const HarmonicSystem& system,
                            const Eigen::MatrixXd& displacement) {
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(displacement.rows(), displacement.cols());
  for (std::size_t h = 1; h < system.harmonics.size(); ++h) {
    const CondensedHarmonic& at = system.harmonics[h];
    const auto j = static_cast<Eigen::Index>(h);
    put_harmonic(model.slope(static_cast<int>(h), system.omega, at, harmonic_of(displacement, j)), j, result);
  }
  return result;
}

}  // namespace dovetail::dynamics
