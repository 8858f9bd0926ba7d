#pragma once

#include <Eigen/Core>
#include <memory>

#include "contact/march.hpp"
#include "contact/pseudo_penalty.hpp"
#include "dynamics/harmonic_system.hpp"
#include "numerics/fourier.hpp"
#include "steady/joint.hpp"

namespace dovetail::steady {

/// Everything constant about f(U) = Z U + lambda(U) - F of a joint: its frequency, contact condition, pseudo-penalty
/// and Fourier basis. Without harmonics (H = 0) its samples are one step of a quasi-static path, marched once.
class Problem {
 public:
  /// At the frequency of `system`, which has the harmonics of the joint's options; their pseudo-penalty is multiplied
  /// by `penalty_ratio`. Throws InputError for conditions of a wrong size.
  Problem(const Joint& joint, std::shared_ptr<const dynamics::HarmonicSystem> system, double penalty_ratio = 1);

  // The same problem with one thing changed.
  [[nodiscard]] Problem at(std::shared_ptr<const dynamics::HarmonicSystem> system) const;
  [[nodiscard]] Problem with_penalty(double ratio) const;
  [[nodiscard]] Problem worn(const Eigen::VectorXd& depth) const;

  [[nodiscard]] const dynamics::CondensedModel& model() const { return *joint_.model; }
  [[nodiscard]] const dynamics::HarmonicSystem& system() const { return *system_; }
  [[nodiscard]] const std::shared_ptr<const dynamics::HarmonicSystem>& shared_system() const { return system_; }
  [[nodiscard]] const numerics::FourierBasis& basis() const { return *basis_; }
  [[nodiscard]] const Options& options() const { return joint_.options; }
  [[nodiscard]] const Condition& condition() const { return joint_.condition; }  ///< no member empty
  [[nodiscard]] const contact::PseudoPenalty& penalty() const { return penalty_; }
  [[nodiscard]] double penalty_ratio() const { return penalty_ratio_; }
  [[nodiscard]] const Eigen::VectorXd& dof_penalty() const { return dof_penalty_; }  ///< eps of each contact dof [nc]
  [[nodiscard]] const Eigen::VectorXd& offset() const { return offset_; }            ///< (g + W) e_N [nc], m
  [[nodiscard]] contact::MarchOptions march_options() const;
  /// The contact law of a node with its data.
  [[nodiscard]] contact::NodeLaw law(Eigen::Index node) const;
  /// Counts the marches and factorisations of this problem; or null.
  [[nodiscard]] const SharedBudget& budget() const { return joint_.options.budget; }

  [[nodiscard]] Eigen::Index unknowns() const { return offset_.rows() * basis_->coefficients(); }
  [[nodiscard]] bool released(Eigen::Index node) const {
    return joint_.condition.released[static_cast<std::size_t>(node)] != 0;
  }
  /// Displacement [nc (2H+1)] over vec(U) that makes a penalty force as large as the excitation: the unit in which
  /// unknowns are O(1) when residuals are relative to the excitation.
  [[nodiscard]] Eigen::VectorXd unit_displacement() const;
  /// Closed contact: u_N = g + W, u_T = X_T, constant in time; released nodes follow linearly.
  [[nodiscard]] Eigen::MatrixXd closed_start() const;

 private:
  void set_penalty();
  void set_offset();

  Joint joint_;
  std::shared_ptr<const dynamics::HarmonicSystem> system_;
  std::shared_ptr<const numerics::FourierBasis> basis_;
  double penalty_ratio_;
  contact::PseudoPenalty penalty_;
  Eigen::VectorXd offset_, dof_penalty_;
};

}  // namespace dovetail::steady
