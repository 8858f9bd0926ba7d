#pragma once

#include <Eigen/Core>
#include <memory>

#include "dynamics/condensed_model.hpp"
#include "steady/options.hpp"

namespace dovetail::steady {

struct PreloadOptions {
  int steps = 20;                 ///< equal load steps from 0 to the full static force, >= 1
  int halvings = 10;              ///< times a load step that does not converge is halved, in [0, 30]
  double tolerance = 1e-10;       ///< residual relative to the static force, > 0
  int max_iterations = 60;        ///< Jacobians per step and penalty, >= 1
  double normal_penalty = 0;      ///< N/m, 0: local contact stiffness
  double tangential_penalty = 0;  ///< N/m, 0: local contact stiffness
  SharedBudget budget = {};       ///< null: not limited
};

/// The static state at the end of the loading path and the friction history it leaves.
struct Preload {
  Status status = Status::iteration_limit;
  int iterations = 0;                 ///< Jacobians of all steps
  Eigen::VectorXd displacement;       ///< U_0 [nc], m
  Eigen::VectorXd full_displacement;  ///< [n] dofs of the reduced model, m
  Eigen::VectorXd force;              ///< lambda_0 [nc], N
  Eigen::VectorXd pressure;           ///< [Nc] Pa
  Eigen::MatrixXd slip_origin;        ///< X_T [Nc, d-1], m: where the vibration's march starts
  Eigen::VectorXd friction_use;       ///< [Nc] |lambda_T| / (mu lambda_N), 0 where separated
};

/// Ramps the static force from 0 to 1 and solves the contact problem of harmonic 0 at every step, each with one
/// march step from the slip of the step before; a step that does not converge is halved. `wear_depth` [Nc] adds to the
/// gaps; may be empty.
[[nodiscard]] Preload quasi_static(const std::shared_ptr<const dynamics::CondensedModel>& model,
                                   const PreloadOptions& options = {}, const Eigen::VectorXd& wear_depth = {});

}  // namespace dovetail::steady

namespace dovetail {
template <>
std::span<const Field<steady::PreloadOptions>> option_table<steady::PreloadOptions>();
}
