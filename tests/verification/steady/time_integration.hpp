#pragma once

#include <Eigen/Core>

#include "reduction/reduced_model.hpp"

namespace dovetail::verification {

/// The last period of a march in time.
struct Periodic {
  int periods = 0;             ///< marched until the motion repeats; 0: it did not
  double friction_energy = 0;  ///< of the contact forces on the slip of that period, J
  double damping_energy = 0;   ///< J
  double input_energy = 0;     ///< J
  Eigen::VectorXd amplitudes;  ///< half of peak to peak of all dofs
  Eigen::MatrixXd slip_end;    ///< tangential displacements at the end of the period [Nc, d-1], m
  bool slips = false, separates = false;
};

/// Time stepping of a model with massless, undamped contact nodes: the trapezoidal rule (average acceleration) for
/// the internal dofs; at the end of every step the contact law holds exactly, u_N <= g, lambda_N >= 0, and where a node
/// slides its slip increment points along the mean of the friction force's directions at both ends of the step (along
/// that at its end, when it did not slide before), so the scheme is of second order but for its first sliding step.
/// Nodes interact through a non-linear Gauss-Seidel iteration to rounding. From rest until all
/// displacements repeat to `tolerance` of their amplitudes.
[[nodiscard]] Periodic march_in_time(const reduction::ReducedModel& model, double omega, int steps_per_period,
                                     double tolerance = 1e-10, int max_periods = 3000);

}  // namespace dovetail::verification
