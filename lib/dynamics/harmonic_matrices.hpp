#pragma once

#include <Eigen/Core>
#include <complex>
#include <memory>
#include <vector>

namespace dovetail::dynamics {

/// L A_h R^T per harmonic h, with L [p, m] and R [q, m] real and A_h [m, m] complex.
struct LowRank {
  const Eigen::MatrixXd& left;
  const std::vector<Eigen::MatrixXcd>& inner;
  const Eigen::MatrixXd& right;
};
/// It (or its conjugate) applied to real coefficients X [q (2H+1), c] as in apply_harmonics: [p (2H+1), c].
[[nodiscard]] Eigen::MatrixXd apply_low_rank(const LowRank& of, const Eigen::MatrixXd& x, bool conjugated);
/// One real matrix A [p, q] applied to all 2H+1 coefficients X [q (2H+1), c]: [p (2H+1), c]. Those that are zero cost
/// nothing.
[[nodiscard]] Eigen::MatrixXd apply_to_all(const Eigen::MatrixXd& a, const Eigen::MatrixXd& x, int harmonics);
/// The same with A^T.
[[nodiscard]] Eigen::MatrixXd apply_transposed_to_all(const Eigen::MatrixXd& a, const Eigen::MatrixXd& x,
                                                      int harmonics);

/// Complex symmetric matrices Z_h [n, n], h = 0..H, Z_0 real. Either dense, or sharing what is static:
/// Z_h = K + L A_h L^T with K [n, n] and L [n, m] real and the same for all and A_h [m, m] small. A product with all
/// harmonics then reads K once, which is what it costs.
class HarmonicMatrices {
 public:
  HarmonicMatrices() = default;
  explicit HarmonicMatrices(std::vector<Eigen::MatrixXcd> dense);
  HarmonicMatrices(std::shared_ptr<const Eigen::MatrixXd> base, std::shared_ptr<const Eigen::MatrixXd> coupling,
                   std::vector<Eigen::MatrixXcd> inner);

  [[nodiscard]] Eigen::Index size() const { return base_ ? base_->rows() : dense_.empty() ? 0 : dense_.front().rows(); }
  [[nodiscard]] int harmonics() const { return static_cast<int>(base_ ? inner_.size() : dense_.size()) - 1; }  ///< H
  [[nodiscard]] Eigen::Index coefficients() const { return 2 * harmonics() + 1; }
  [[nodiscard]] bool all_finite() const;  ///< where what is shared is
  /// Numbers that a product with all harmonics reads.
  [[nodiscard]] double entries() const;

  /// Z_h; its rows first .. first + count; and Z_0.
  [[nodiscard]] Eigen::MatrixXcd matrix(int h) const { return rows(h, 0, size()); }
  [[nodiscard]] Eigen::MatrixXcd rows(int h, Eigen::Index first, Eigen::Index count) const;
  [[nodiscard]] Eigen::MatrixXd mean() const;
  /// All of them applied to real coefficients X [n (2H+1), c], as apply_harmonics does. The transpose of this real
  /// operator is that of the conjugates.
  [[nodiscard]] Eigen::MatrixXd apply(const Eigen::MatrixXd& x, bool conjugated = false) const;
  /// Rows `dofs` of it, of each coefficient: [dofs (2H+1), c].
  [[nodiscard]] Eigen::MatrixXd apply_at(const std::vector<Eigen::Index>& dofs, const Eigen::MatrixXd& x) const;
  /// The same of one column per block of d dofs, which is local[i] [d, 2H+1] there and zero elsewhere:
  /// [n (2H+1), n / d].
  [[nodiscard]] Eigen::MatrixXd apply_to_blocks(const std::vector<Eigen::MatrixXd>& local, bool conjugated) const;

  /// Z_h + diag(values): dense from then on.
  void add_to_diagonal(int h, const Eigen::VectorXcd& values);

  /// What they share; null where they are dense.
  [[nodiscard]] const std::shared_ptr<const Eigen::MatrixXd>& base() const { return base_; }          ///< K
  [[nodiscard]] const std::shared_ptr<const Eigen::MatrixXd>& coupling() const { return coupling_; }  ///< L
  [[nodiscard]] const std::vector<Eigen::MatrixXcd>& inner() const { return inner_; }                 ///< A_h

 private:
  /// The product where none but these dofs are other than zero.
  [[nodiscard]] Eigen::MatrixXd apply_from(const std::vector<Eigen::Index>& dofs, const Eigen::MatrixXd& x,
                                           bool conjugated) const;

  std::shared_ptr<const Eigen::MatrixXd> base_, coupling_;
  std::vector<Eigen::MatrixXcd> inner_;
  std::vector<Eigen::MatrixXcd> dense_;
};

}  // namespace dovetail::dynamics
