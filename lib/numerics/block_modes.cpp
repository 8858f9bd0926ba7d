#include "numerics/block_modes.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <random>
#include <vector>

#include "numerics/dense_product.hpp"

namespace dovetail::numerics {

namespace {

template <class Scalar>
using Dense = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>;

/// M times blocks of columns, row by row of M, without its stored zeros (a mass matrix on the pattern of a stiffness is
/// mostly zeros).
template <class Scalar>
class Weight;

using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
using SparseRows = Eigen::SparseMatrix<double, Eigen::RowMajor>;

template <>
class Weight<double> {
 public:
  explicit Weight(const Eigen::SparseMatrix<double>& mass) : mass_(mass) { mass_.prune(0.0); }
  [[nodiscard]] Eigen::MatrixXd operator()(const Eigen::MatrixXd& x) const {
    const Rows rows = x;
    const Rows product = mass_ * rows;
    return product;
  }

 private:
  SparseRows mass_;
};

/// Cyclic symmetry makes few entries complex, and complex products cost several real ones: real and imaginary parts
/// side by side.
template <>
class Weight<std::complex<double>> {
 public:
  explicit Weight(const Eigen::SparseMatrix<std::complex<double>>& mass) : real_(mass.real()), imag_(mass.imag()) {
    real_.prune(0.0);
    imag_.prune(0.0);
  }
  [[nodiscard]] Eigen::MatrixXcd operator()(const Eigen::MatrixXcd& x) const {
    const Eigen::Index k = x.cols();
    Rows parts(x.rows(), 2 * k), turned(x.rows(), 2 * k);
    parts << x.real(), x.imag();
    turned << -x.imag(), x.real();
    Rows product = real_ * parts;
    product += imag_ * turned;
    Eigen::MatrixXcd result(x.rows(), k);
    result.real() = product.leftCols(k);
    result.imag() = product.rightCols(k);
    return result;
  }

 private:
  SparseRows real_, imag_;
};

// Tall products on OpenBLAS.
Eigen::MatrixXd times(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  Eigen::MatrixXd c;
  product(a, b, c);
  return c;
}
Eigen::MatrixXcd times(const Eigen::MatrixXcd& a, const Eigen::MatrixXcd& b) {
  return product(a, b);
}
Eigen::MatrixXd adjoint_times(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  return transposed_product(a, b);
}
Eigen::MatrixXcd adjoint_times(const Eigen::MatrixXcd& a, const Eigen::MatrixXcd& b) {
  return transposed_product(a.conjugate(), b);
}

/// A block made M-orthonormal: x = vectors factor (+ what was projected out before).
template <class Scalar>
struct Orthonormal {
  Dense<Scalar> vectors, weighted;  // Q and M Q
  Dense<Scalar> factor;             // [columns of Q, columns of x]
};

/// Directions below `threshold` times the largest scale are dropped: the space is exhausted there.
template <class Scalar>
Orthonormal<Scalar> orthonormal(const Dense<Scalar>& x, const Dense<Scalar>& weighted, double threshold) {
  if (x.cols() == 0) return {x, weighted, Dense<Scalar>(0, 0)};
  const Dense<Scalar> gram = adjoint_times(x, weighted);
  const Eigen::SelfAdjointEigenSolver<Dense<Scalar>> eigen(0.5 * (gram + gram.adjoint()));
  std::vector<Eigen::Index> kept;
  for (Eigen::Index k = 0; k < gram.rows(); ++k)
    if (eigen.eigenvalues()(k) > threshold * threshold) kept.push_back(k);
  const Eigen::VectorXd sizes = eigen.eigenvalues()(kept).cwiseSqrt();
  const Dense<Scalar> directions = eigen.eigenvectors()(Eigen::all, kept);
  const Dense<Scalar> scaled = directions * sizes.cwiseInverse().asDiagonal();
  return {x * scaled, weighted * scaled, sizes.asDiagonal() * directions.adjoint()};
}

template <class Scalar>
class Krylov {
 public:
  Krylov(const ShiftInverse<Scalar>& inverse, const Eigen::SparseMatrix<Scalar>& mass, const ModesOptions& options)
      : inverse_(inverse),
        weight_(mass),
        count_(std::min<Eigen::Index>(options.count, inverse.rows)),
        tolerance_(options.tolerance),
        block_size_(std::min<Eigen::Index>(options.block > 0 ? options.block : kLargeBlock, inverse.rows)),
        limit_(3 * Eigen::Index{options.vector_limit} * options.count + 400),
        most_(std::min<Eigen::Index>(inverse.rows, 3 * count_ + 5 * block_size_)) {}

  Modes<Scalar> run() {
    Modes<Scalar> modes;
    if (!start()) {
      modes.status = Status::not_finite;
      return modes;
    }
    while (true) {
      if (solves_ + block_.vectors.cols() > limit_) return modes;
      const bool exhausted = !expand();
      if (!projected_.allFinite()) {
        modes.status = Status::not_finite;
        return modes;
      }
      const bool enough = settle();
      if (enough || exhausted) {
        modes.status = Status::converged;
        const Eigen::Index found = std::min<Eigen::Index>(count_, values_.size());
        take(found, modes);
        return modes;
      }
      if (basis_.cols() + block_.vectors.cols() > most_) restart();
    }
  }

 private:
  /// A random block, once through the operator: it has no part along massless directions then.
  bool start() {
    std::mt19937_64 random(1);
    std::uniform_real_distribution<double> uniform(-1, 1);
    Dense<Scalar> x(inverse_.rows, block_size_);
    for (Scalar& entry : x.reshaped()) {
      entry = uniform(random);
      if constexpr (!std::is_same_v<Scalar, double>) entry += Scalar(0, uniform(random));
    }
    const Dense<Scalar> image = inverse_.perform_block(weight_(x));
    solves_ += x.cols();
    if (!image.allFinite()) return false;
    const Dense<Scalar> weighted = weight_(image);
    const double scale = std::sqrt(std::abs((image.adjoint() * weighted).trace()));
    // Twice: a Gram matrix squares the condition of the block.
    const Orthonormal<Scalar> first = orthonormal<Scalar>(image, weighted, 1e-12 * scale);
    block_ = orthonormal<Scalar>(first.vectors, weight_(first.vectors), 1e-3);
    basis_.resize(inverse_.rows, 0);
    return block_.vectors.cols() > 0;
  }

  /// Takes the block into the basis and makes the next one of its image; false when nothing is left.
  bool expand() {
    const Eigen::Index before = basis_.cols(), added = block_.vectors.cols();
    basis_.conservativeResize(Eigen::NoChange, before + added);
    basis_.rightCols(added) = block_.vectors;
    Dense<Scalar> image = inverse_.perform_block(block_.weighted);
    solves_ += added;
    const Dense<Scalar> weighted = weight_(image);
    const double scale = std::sqrt(std::abs((image.adjoint() * weighted).trace()));
    const Dense<Scalar> overlap = adjoint_times(basis_, weighted);
    projected_.conservativeResize(before + added, before + added);
    projected_.rightCols(added) = overlap;
    projected_.bottomRows(added) = overlap.adjoint();
    image -= times(basis_, overlap);
    // Small remainders carry rounding along the basis, which normalising magnifies: again.
    Orthonormal<Scalar> first = orthonormal<Scalar>(image, weight_(image), 1e-13 * scale);
    first.vectors -= times(basis_, adjoint_times(basis_, first.weighted));
    block_ = orthonormal<Scalar>(first.vectors, weight_(first.vectors), 1e-3);
    block_.factor = (block_.factor * first.factor).eval();
    last_ = added;
    return block_.vectors.cols() > 0 && basis_.cols() < inverse_.rows;
  }

  /// Ritz values by decreasing magnitude; whether those wanted have small residuals.
  bool settle() {
    const Eigen::SelfAdjointEigenSolver<Dense<Scalar>> eigen(0.5 * (projected_ + projected_.adjoint()));
    std::vector<Eigen::Index> order(static_cast<std::size_t>(projected_.rows()));
    for (std::size_t k = 0; k < order.size(); ++k) order[k] = static_cast<Eigen::Index>(k);
    std::stable_sort(order.begin(), order.end(), [&](Eigen::Index a, Eigen::Index b) {
      return std::abs(eigen.eigenvalues()(a)) > std::abs(eigen.eigenvalues()(b));
    });
    values_ = eigen.eigenvalues()(order);
    rotation_ = eigen.eigenvectors()(Eigen::all, order);
    coupling_ = block_.factor * rotation_.bottomRows(last_);
    if (values_.size() < count_) return false;
    for (Eigen::Index k = 0; k < count_; ++k)
      if (!(coupling_.col(k).norm() <= tolerance_ * std::abs(values_(k)))) return false;
    return true;
  }

  /// Keeps the best Ritz vectors; what couples them to the next block is known.
  void restart() {
    const Eigen::Index kept = std::min<Eigen::Index>(count_ + block_size_, values_.size() - 1);
    basis_ = times(basis_, Dense<Scalar>(rotation_.leftCols(kept)));
    projected_ = values_.head(kept).template cast<Scalar>().asDiagonal();
  }

  void take(Eigen::Index found, Modes<Scalar>& modes) const {
    // Values that are rounding belong to no finite eigenvalue.
    constexpr double kRange = 1e14;
    while (found > 0 && std::abs(values_(found - 1)) * kRange < std::abs(values_(0))) --found;
    std::vector<Eigen::Index> order(static_cast<std::size_t>(found));
    for (std::size_t k = 0; k < order.size(); ++k) order[k] = static_cast<Eigen::Index>(k);
    std::sort(order.begin(), order.end(),
              [&](Eigen::Index a, Eigen::Index b) { return 1 / values_(a) < 1 / values_(b); });
    modes.eigenvalues = values_(order).cwiseInverse();
    modes.vectors = basis_ * rotation_(Eigen::all, order);
  }

  const ShiftInverse<Scalar>& inverse_;
  Weight<Scalar> weight_;
  Eigen::Index count_;
  double tolerance_;
  Eigen::Index block_size_, limit_, most_, solves_ = 0, last_ = 0;
  Dense<Scalar> basis_, projected_;  // V and V^H M (K - sigma M)^{-1} M V
  Orthonormal<Scalar> block_;        // the next one
  Eigen::VectorXd values_;
  Dense<Scalar> rotation_, coupling_;
};

}  // namespace

template <class Scalar>
Modes<Scalar> block_modes(const ShiftInverse<Scalar>& inverse, const Eigen::SparseMatrix<Scalar>& mass,
                          const ModesOptions& options) {
  assert(options.count >= 1 && options.count <= inverse.rows && mass.rows() == inverse.rows && inverse.perform_block);
  Modes<Scalar> modes = Krylov<Scalar>(inverse, mass, options).run();
  modes.shift = options.shift;
  modes.eigenvalues.array() += options.shift;
  return modes;
}

template Modes<double> block_modes(const ShiftInverse<double>&, const Eigen::SparseMatrix<double>&,
                                   const ModesOptions&);
template Modes<std::complex<double>> block_modes(const ShiftInverse<std::complex<double>>&,
                                                 const Eigen::SparseMatrix<std::complex<double>>&, const ModesOptions&);

}  // namespace dovetail::numerics
