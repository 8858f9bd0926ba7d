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
/// Cost: one complex factorisation of Z_oo per harmonic, a fraction of about 1 / (2H+1)^2 of what the open dofs would
/// add to the factorisation of J.
class SeparatedNodes {
 public:
  /// `open` and `kept` together are all contact dofs, each ascending.
  SeparatedNodes(std::shared_ptr<const dynamics::HarmonicSystem> system, std::vector<Eigen::Index> open,
                 std::vector<Eigen::Index> kept);

  /// `singular`: nothing holds the open part.
  [[nodiscard]] Status status() const { return status_; }
  /// Smallest estimate of 1 / (|Z_oo| |Z_oo^-1|) over the harmonics; 1 when nothing is open.
  [[nodiscard]] double reciprocal_condition() const { return reciprocal_condition_; }
  /// Sign of det Z_oo over all harmonics: that of harmonic 0, the others are squares.
  [[nodiscard]] int determinant_sign() const;
  [[nodiscard]] const std::vector<Eigen::Index>& open() const { return open_; }
  [[nodiscard]] const std::vector<Eigen::Index>& kept() const { return kept_; }
  /// Z~_h [kept, kept]; views of this object.
  [[nodiscard]] std::vector<const Eigen::MatrixXcd*> stiffness() const;

  /// Coefficients of some dofs out of those of all, and back.
  [[nodiscard]] Eigen::MatrixXd part_of(const std::vector<Eigen::Index>& dofs, const Eigen::MatrixXd& all) const;
  void put_part(const std::vector<Eigen::Index>& dofs, const Eigen::MatrixXd& part, Eigen::MatrixXd& all) const;

  /// Z_oo^-1 B, or its transpose.
  [[nodiscard]] Eigen::MatrixXd solve_open(const Eigen::MatrixXd& b, bool transposed) const;
  /// S applied from kept to open dofs (plain, conjugated) or from open to kept ones (transposed: Z_ko Z_oo^-1;
  /// adjoint).
  [[nodiscard]] Eigen::MatrixXd apply_shape(dynamics::Form form, const Eigen::MatrixXd& x) const;

 private:
  std::shared_ptr<const dynamics::HarmonicSystem> system_;
  std::vector<Eigen::Index> open_, kept_;
  std::vector<Eigen::MatrixXcd> condensed_;  // Z~; empty when nothing is open
  std::vector<Eigen::MatrixXcd> shape_;      // S
  std::vector<numerics::ComplexLu> factors_;
  Status status_ = Status::converged;
  double reciprocal_condition_ = 1;
};

}  // namespace dovetail::steady
