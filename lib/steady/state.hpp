#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "core/status.hpp"
#include "steady/solve.hpp"

namespace dovetail::steady {

/// What one contact node does over the period.
struct NodeSummary {
  bool slips = false;                                 ///< slipped under load at some sample
  bool separates = false;                             ///< carried no force at some sample
  bool carries_load = false;                          ///< carried force at some sample
  bool stuck = false;                                 ///< in contact and without slip at all samples
  double min_normal_force = 0, max_normal_force = 0;  ///< lambda_N, N
  double min_pressure = 0, max_pressure = 0;          ///< lambda_N / area, Pa
  double slip_distance = 0;                           ///< path of X_T under load per cycle, m
  double slip_load = 0;                               ///< int lambda_N |dX_T| per cycle, N m
  double wear_rate = 0;                               ///< depth per cycle, m
  double dissipated_energy = 0;                       ///< J per cycle
  int periods = 0;                                    ///< marched until periodic
};

/// Everything reported of a point.
struct Summary {
  double omega = 0;          ///< rad/s
  double residual = 0;       ///< |f| relative to the excitation
  double penalty_ratio = 1;  ///< of the cascade; the eps used is in `penalty`
  contact::PseudoPenalty penalty;
  Eigen::MatrixXd displacement;    ///< U [nc, 2H+1], m
  Eigen::MatrixXd force;           ///< lambda [nc, 2H+1], N
  Eigen::MatrixXd slip_end;        ///< X_T at the end of the period [Nc, d-1], m
  std::vector<NodeSummary> nodes;  ///< [Nc]
  Eigen::VectorXd wear_rate;       ///< depth per cycle [Nc], m
  Eigen::MatrixXd outputs;         ///< [n_out, 2H+1] Fourier coefficients
  Eigen::VectorXd amplitudes;      ///< [n_out] half the peak-to-peak value
  double input_energy = 0;         ///< put in by the excitation, J per cycle
  double damping_energy = 0;       ///< dissipated by the damping matrix, J per cycle
  double friction_energy = 0;      ///< dissipated by friction, from increments of X_T, J per cycle
  double contact_work = 0;  ///< of the truncated contact force on the truncated velocity; input - damping exactly
  double error_force = 0;   ///< e_lambda [Salles 2009, eq. 36]
  double error_energy = 0;  ///< e_E [Salles 2009, eq. 38]
};
[[nodiscard]] Summary summarise(const Point& point);

/// One steady state. Nothing in it is meaningful unless status is converged, but all of it is filled with the
/// best point found.
struct State : Summary, Work {
  Status status = Status::iteration_limit;
  /// Jacobian at the solution, for predictors and sensitivities; null when the solve failed or it was not asked for.
  std::shared_ptr<const Tangent> tangent = {};
};

/// What becomes of the Jacobian of a state found.
enum class AtSolution {
  linearise,     ///< kept, factorised
  show_regular,  ///< factorised and forgotten
  trust,         ///< not looked at
};

/// What there is to say of a point found with `status`: everything of a State but the work. A converged point whose
/// Jacobian is singular becomes Status::singular unless it is trusted. `previous`, met on the way, lends its factors
/// where the Jacobian is the same.
[[nodiscard]] State described(Point point, Status status, AtSolution jacobian, const Tangent* previous = nullptr);

}  // namespace dovetail::steady
