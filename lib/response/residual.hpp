#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "contact/march.hpp"
#include "contact/pseudo_penalty.hpp"
#include "numerics/fourier.hpp"
#include "response/condensed_model.hpp"
#include "response/jacobian.hpp"
#include "response/options.hpp"

namespace dovetail::response {

/// What the contact is like, besides the model: empty members mean no wear, nothing released, the model's origin.
struct ContactCondition {
  Eigen::VectorXd wear_depth = {};   ///< W [Nc], m, both surfaces together; or empty
  std::vector<char> released = {};   ///< [Nc] nonzero: the node carries no contact force; or empty
  Eigen::MatrixXd slip_origin = {};  ///< X_T at which the march starts [Nc, d-1], m; or empty
};

/// All harmonics of the dynamic stiffness at one frequency.
struct HarmonicSystem {
  double omega = 0;                          ///< rad/s
  std::vector<HarmonicStiffness> harmonics;  ///< [H+1]
  Eigen::MatrixXd force;                     ///< F [nc, 2H+1], N
  double force_scale = 0;  ///< norm of F over harmonics >= 1, or of F_0 when that is zero: residuals are relative to it
  Status status = Status::converged;
};

/// Assembles harmonics 0..H at omega (rad/s, > 0 unless H = 0).
[[nodiscard]] HarmonicSystem harmonic_system(const CondensedModel& model, int harmonics, double omega,
                                             double static_scale = 1);
/// Z U for U [nc, 2H+1], harmonic by harmonic; and dZ/dw U - dF/dw.
[[nodiscard]] Eigen::MatrixXd apply_stiffness(const HarmonicSystem& system, const Eigen::MatrixXd& displacement);
[[nodiscard]] Eigen::MatrixXd residual_slope_linear(const CondensedModel& model, const HarmonicSystem& system,
                                                    const Eigen::MatrixXd& displacement);

/// A point of the residual: everything the march said about it.
struct ResidualState {
  Eigen::MatrixXd displacement;             ///< U [nc, 2H+1], m
  Eigen::MatrixXd prediction;               ///< lambda_u [nc, 2H+1], N
  Eigen::MatrixXd force;                    ///< lambda [nc, 2H+1], N
  Eigen::MatrixXd residual;                 ///< f = Z U + lambda - F [nc, 2H+1], N
  std::vector<contact::MarchResult> nodes;  ///< [Nc]; with_derivative fills the blocks D
  bool has_derivative = false;
  Status status = Status::converged;  ///< converged, not_periodic or not_finite
};

/// f(U) = Z U + lambda(U) - F of one frequency, contact condition and pseudo-penalty, and its Jacobian in nodal
/// blocks: D is block-diagonal over nodes, Z over harmonics, and no product of full size is ever formed.
class SteadyResidual {
 public:
  SteadyResidual(std::shared_ptr<const CondensedModel> model, std::shared_ptr<const HarmonicSystem> system,
                 numerics::FourierBasis basis, contact::PseudoPenalty penalty, ContactCondition condition,
                 contact::MarchOptions march, SharedBudget budget = {});

  [[nodiscard]] const CondensedModel& model() const { return *model_; }
  [[nodiscard]] const HarmonicSystem& system() const { return *system_; }
  [[nodiscard]] const std::shared_ptr<const HarmonicSystem>& shared_system() const { return system_; }
  [[nodiscard]] const numerics::FourierBasis& basis() const { return basis_; }
  [[nodiscard]] const contact::PseudoPenalty& penalty() const { return penalty_; }
  [[nodiscard]] const ContactCondition& condition() const { return condition_; }  ///< no member empty
  [[nodiscard]] Eigen::Index unknowns() const { return offset_.rows() * basis_.coefficients(); }
  [[nodiscard]] bool released(Eigen::Index node) const {
    return condition_.released[static_cast<std::size_t>(node)] != 0;
  }
  /// Counts the marches and factorisations of this problem; or null.
  [[nodiscard]] const SharedBudget& budget() const { return budget_; }
  [[nodiscard]] double penalty_of(Eigen::Index contact_dof) const { return dof_penalty_(contact_dof); }

  /// Evaluates f at U [nc, 2H+1], with the nodal blocks D when asked. O(nc^2 H + Nc N m d).
  void evaluate(const Eigen::MatrixXd& displacement, bool with_derivative, ResidualState& state) const;

  /// The full Jacobian J = Z + D (eps I - Z) [nc (2H+1)]^2 over vec(U). O(n^2 d), n = nc (2H+1). The budget counts its
  /// factorisation, too.
  [[nodiscard]] Eigen::MatrixXd jacobian(const ResidualState& state) const;
  /// The same into storage that is kept: a fresh large matrix costs more in page faults than in operations.
  void jacobian(const ResidualState& state, Eigen::MatrixXd& into) const;
  /// Its rows `rows` only (indices into vec(U), ascending).
  [[nodiscard]] Eigen::MatrixXd jacobian_rows(const ResidualState& state, const std::vector<Eigen::Index>& rows) const;
  /// Z, D and eps of all nodes; views of this problem and of `state`.
  [[nodiscard]] JacobianBlocks blocks(const ResidualState& state) const;
  /// D applied to a change of lambda_u, [nc, 2H+1] to [nc, 2H+1].
  [[nodiscard]] Eigen::MatrixXd apply_force_derivative(const ResidualState& state, const Eigen::MatrixXd& change) const;

  /// Closed contact: u_N = g + W, u_T = X_T, constant in time; released nodes follow linearly.
  [[nodiscard]] Eigen::MatrixXd closed_start() const;
  /// Norm of the residual relative to the excitation.
  [[nodiscard]] double relative_norm(const Eigen::MatrixXd& residual) const;

 private:
  std::shared_ptr<const CondensedModel> model_;
  std::shared_ptr<const HarmonicSystem> system_;
  numerics::FourierBasis basis_;
  contact::PseudoPenalty penalty_;
  ContactCondition condition_;
  contact::MarchOptions march_;
  SharedBudget budget_;
  Eigen::VectorXd offset_;       // (g + W) e_N [nc]
  Eigen::VectorXd dof_penalty_;  // eps [nc]
};

}  // namespace dovetail::response
