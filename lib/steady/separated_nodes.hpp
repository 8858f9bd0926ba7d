#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "core/status.hpp"
#include "dynamics/harmonic_blocks.hpp"
#include "dynamics/harmonic_system.hpp"
#include "numerics/dense_lu.hpp"

namespace dovetail::steady {

/// Contact dofs that carry no force at any time obey Z U = F next to the others: linear, harmonic by harmonic.
/// Condensing these `open` dofs, Z~ = Z_kk - Z_ko S with S = Z_oo^-1 Z_ok, leaves a system of the same form in the kept
/// ones, J~ = Z~ + D (eps I - Z~). Coefficient vectors are vec(U), [dofs (2H+1), q].
/// Where the harmonics share Z_h = K + L A_h L^T they share Z~_h = K~ + L~ B_h L~^T, too, with
///   T = K_oo^-1 K_ok, P = K_oo^-1 L_o, K~ = K_kk - K_ko T, L~ = L_k - K_ko P, B_h = (A_h^-1 + L_o^T P)^-1,
///   S_h = T + P B_h L~^T, (Z_oo)^-1 = K_oo^-1 - P B_h P^T:
/// one real factorisation of K_oo. Else one complex factorisation of Z_oo per harmonic.
class SeparatedNodes {
 public:
  /// `open` and `kept` together are all contact dofs, each ascending.
  SeparatedNodes(std::shared_ptr<const dynamics::HarmonicSystem> system, std::vector<Eigen::Index> open,
                 std::vector<Eigen::Index> kept);

  /// Whether they are these ones of this system.
  [[nodiscard]] bool are(const dynamics::HarmonicSystem& system, const std::vector<Eigen::Index>& open) const {
    return system_.get() == &system && open_ == open;
  }
  /// `singular`: nothing holds the open part.
  [[nodiscard]] Status status() const { return status_; }
  /// Smallest estimate of 1 / (|Z_oo| |Z_oo^-1|) over the harmonics; 1 when nothing is open.
  [[nodiscard]] double reciprocal_condition() const { return reciprocal_condition_; }
  /// Sign of det Z_oo over all harmonics: that of harmonic 0, the others are squares.
  [[nodiscard]] int determinant_sign() const { return status_ == Status::converged ? determinant_sign_ : 0; }
  [[nodiscard]] const std::vector<Eigen::Index>& open() const { return open_; }
  [[nodiscard]] const std::vector<Eigen::Index>& kept() const { return kept_; }
  /// Z~ [kept, kept], of this object or the system.
  [[nodiscard]] const dynamics::HarmonicMatrices& stiffness() const {
    return open_.empty() ? system_->stiffness : condensed_;
  }
  [[nodiscard]] double operations() const { return operations_; }  ///< that condensing them took

  /// Coefficients of some dofs out of those of all, and back.
  [[nodiscard]] Eigen::MatrixXd part_of(const std::vector<Eigen::Index>& dofs, const Eigen::MatrixXd& all) const;
  void put_part(const std::vector<Eigen::Index>& dofs, const Eigen::MatrixXd& part, Eigen::MatrixXd& all) const;

  /// Z_oo^-1 B, or its transpose.
  [[nodiscard]] Eigen::MatrixXd solve_open(const Eigen::MatrixXd& b, bool transposed) const;
  /// S applied from kept to open dofs (plain, conjugated) or from open to kept ones (transposed: Z_ko Z_oo^-1;
  /// adjoint).
  [[nodiscard]] Eigen::MatrixXd apply_shape(dynamics::Form form, const Eigen::MatrixXd& x) const;

 private:
  /// False where K_oo is singular, although Z_oo may be regular.
  bool condense_shared();
  void condense_each();
  [[nodiscard]] bool take(double reciprocal_condition);

  std::shared_ptr<const dynamics::HarmonicSystem> system_;
  std::vector<Eigen::Index> open_, kept_;
  dynamics::HarmonicMatrices condensed_;  // Z~; empty when nothing is open
  // Of each harmonic where they share nothing.
  std::vector<Eigen::MatrixXcd> shape_;  // S
  std::vector<numerics::ComplexLu> factors_;
  // Of what they share.
  numerics::DenseLu base_;                 // K_oo
  Eigen::MatrixXd static_shape_, pushed_;  // T, P
  Status status_ = Status::converged;
  double reciprocal_condition_ = 1, operations_ = 0;
  int determinant_sign_ = 1;
};

}  // namespace dovetail::steady
