#include "numerics/nearest_modes.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <random>
#include <vector>

#include "core/interruption.hpp"
#include "numerics/dense_product.hpp"
#include "numerics/dense_symmetric.hpp"
#include "numerics/params.hpp"
#include "numerics/sparse_product.hpp"

namespace dovetail::numerics {

namespace {

/// M times blocks of columns, row by row of M, without its stored zeros (a mass matrix on the pattern of a stiffness is
/// mostly zeros). Outlived by a real M, of which a copy is made where there are such zeros only.
template <class Scalar>
class Weight;

template <>
class Weight<double> {
 public:
  explicit Weight(const Eigen::SparseMatrix<double>& mass) : mass_(&mass) {
    if (!mass.isCompressed() || !(mass.coeffs() == 0).any()) return;
    pruned_ = mass.pruned();
    mass_ = &pruned_;
  }
  Weight(const Weight&) = delete;
  Weight& operator=(const Weight&) = delete;
  [[nodiscard]] Eigen::MatrixXd operator()(const Eigen::MatrixXd& x) const { return symmetric_product(*mass_, x); }

 private:
  Eigen::SparseMatrix<double> pruned_;
  const Eigen::SparseMatrix<double>* mass_;
};

using SparseRows = Eigen::SparseMatrix<double, Eigen::RowMajor>;

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
    const Rows both = product(real_, parts) + product(imag_, turned);
    Eigen::MatrixXcd result(x.rows(), k);
    result.real() = both.leftCols(k);
    result.imag() = both.rightCols(k);
    return result;
  }

 private:
  SparseRows real_, imag_;
};

/// A block made M-orthonormal: x = vectors factor (+ what was projected out before).
template <class Scalar>
struct Orthonormal {
  Dense<Scalar> vectors, weighted;  // Q and M Q
  Dense<Scalar> factor;             // [columns of Q, columns of x]
};

/// Square root of sum_k x_k^H y_k over the columns.
template <class Scalar>
double joint_length(const Dense<Scalar>& x, const Dense<Scalar>& y) {
  return std::sqrt(std::abs(x.conjugate().cwiseProduct(y).sum()));
}

template <class Scalar>
class Krylov {
  static constexpr ModesParams kParams = {};

 public:
  Krylov(const ShiftInverse<Scalar>& inverse, const Eigen::SparseMatrix<Scalar>& mass, const ModesOptions& options)
      : inverse_(inverse),
        weight_(mass),
        count_(std::min<Eigen::Index>(options.count, inverse.rows)),
        tolerance_(options.tolerance),
        block_size_(std::min<Eigen::Index>(
            options.block > 0 ? options.block : (inverse.rows < kParams.large ? kParams.block : kParams.large_block),
            inverse.rows)),
        limit_(3 * Eigen::Index{options.vector_limit} * options.count + kParams.always),
        most_(std::min<Eigen::Index>(inverse.rows, kParams.vectors * count_ + kParams.blocks * block_size_)) {}

  Modes<Scalar> run() {
    Modes<Scalar> modes;
    if (!start()) {
      modes.status = Status::not_finite;
      return modes;
    }
    while (true) {
      if (solves_ + block_.vectors.cols() > limit_) return modes;
      const bool exhausted = !expand();
      const bool enough = settle();
      if (status_ != Status::converged) {
        modes.status = status_;
        return modes;
      }
      if (enough || exhausted) {
        modes.status = Status::converged;
        const Eigen::Index found = std::min<Eigen::Index>(count_, values_.size());
        take(found, modes);
        return modes;
      }
      if (size_ + block_.vectors.cols() > most_) restart();
    }
  }

 private:
  /// Of a matrix that is Hermitian but for rounding. Failures are kept in status_.
  Pairs<Scalar> pairs_of(const Dense<Scalar>& matrix) {
    Pairs<Scalar> pairs = all_pairs<Scalar>(0.5 * (matrix + matrix.adjoint()));
    if (pairs.status != Status::converged) status_ = pairs.status;
    return pairs;
  }

  /// Directions below `threshold` times the largest scale are dropped: the space is exhausted there.
  Orthonormal<Scalar> orthonormal(const Dense<Scalar>& x, const Dense<Scalar>& weighted, double threshold) {
    const Pairs<Scalar> pairs = pairs_of(adjoint_product(x, weighted));
    std::vector<Eigen::Index> kept;
    for (Eigen::Index k = 0; k < pairs.values.size(); ++k)
      if (pairs.values(k) > threshold * threshold) kept.push_back(k);
    const Eigen::VectorXd sizes = pairs.values(kept).cwiseSqrt();
    const Dense<Scalar> directions = pairs.vectors(Eigen::all, kept);
    const Dense<Scalar> scaled = directions * sizes.cwiseInverse().asDiagonal();
    return {product(x, scaled), product(weighted, scaled), sizes.asDiagonal() * directions.adjoint()};
  }

  /// A random block, once through the operator: it has no part along massless directions then.
  bool start() {
    std::mt19937_64 random(1);
    std::uniform_real_distribution<double> uniform(-1, 1);
    Dense<Scalar> x(inverse_.rows, block_size_);
    for (Scalar& entry : x.reshaped()) {
      entry = uniform(random);
      if constexpr (!std::is_same_v<Scalar, double>) entry += Scalar(0, uniform(random));
    }
    const Dense<Scalar> image = inverse_.solve(weight_(x));
    solves_ += x.cols();
    if (!image.allFinite()) return false;
    const Dense<Scalar> weighted = weight_(image);
    const double scale = joint_length<Scalar>(image, weighted);
    // Twice: a Gram matrix squares the condition of the block.
    const Orthonormal<Scalar> first = orthonormal(image, weighted, kParams.independent * scale);
    block_ = orthonormal(first.vectors, weight_(first.vectors), kParams.second);
    space_.resize(inverse_.rows, most_ + block_size_);
    return block_.vectors.cols() > 0;
  }

  /// Takes the block into the basis and makes the next one of its image; false when nothing is left.
  bool expand() {
    end_if_interrupted();
    const Eigen::Index before = size_, added = block_.vectors.cols();
    space_.middleCols(before, added) = block_.vectors;
    size_ += added;
    Dense<Scalar> image = inverse_.solve(block_.weighted);
    solves_ += added;
    const Dense<Scalar> weighted = weight_(image);
    const double scale = joint_length<Scalar>(image, weighted);
    // The image of a block is orthogonal to all blocks but the last two and what a restart kept.
    const auto near = space_.middleCols(coupled_, size_ - coupled_);
    const Dense<Scalar> overlap = adjoint_product(near, weighted);
    projected_.conservativeResize(before + added, before + added);
    projected_.rightCols(added).setZero();
    projected_.bottomRows(added).setZero();
    projected_.bottomRows(added).rightCols(overlap.rows()) = overlap.adjoint();
    projected_.rightCols(added).bottomRows(overlap.rows()) = overlap;
    image -= product(near, overlap);
    coupled_ = before;
    // Small remainders carry rounding along the whole basis, which normalising magnifies.
    const auto basis = space_.leftCols(size_);
    Orthonormal<Scalar> first = orthonormal(image, weight_(image), kParams.remainder * scale);
    first.vectors -= product(basis, adjoint_product(basis, first.weighted));
    block_ = orthonormal(first.vectors, weight_(first.vectors), kParams.second);
    block_.factor = product(block_.factor, first.factor);
    last_ = added;
    return block_.vectors.cols() > 0 && size_ < inverse_.rows;
  }

  /// Ritz values by decreasing magnitude; whether those wanted have small residuals.
  bool settle() {
    const Pairs<Scalar> ritz = pairs_of(projected_);
    std::vector<Eigen::Index> order(static_cast<std::size_t>(ritz.values.size()));
    for (std::size_t k = 0; k < order.size(); ++k) order[k] = static_cast<Eigen::Index>(k);
    std::stable_sort(order.begin(), order.end(), [&](Eigen::Index a, Eigen::Index b) {
      return std::abs(ritz.values(a)) > std::abs(ritz.values(b));
    });
    values_ = ritz.values(order);
    rotation_ = ritz.vectors(Eigen::all, order);
    if (values_.size() < count_) return false;
    coupling_ = product(block_.factor, rotation_.bottomRows(last_));
    for (Eigen::Index k = 0; k < count_; ++k)
      if (!(coupling_.col(k).norm() <= tolerance_ * std::abs(values_(k)))) return false;
    return true;
  }

  /// Keeps the best Ritz vectors; what couples them to the next block is known.
  void restart() {
    const Eigen::Index kept = std::min<Eigen::Index>(count_ + block_size_, values_.size() - 1);
    const Dense<Scalar> best = product(space_.leftCols(size_), Dense<Scalar>(rotation_.leftCols(kept)));
    space_.leftCols(kept) = best;
    size_ = kept;
    coupled_ = 0;
    projected_ = values_.head(kept).template cast<Scalar>().asDiagonal();
  }

  void take(Eigen::Index found, Modes<Scalar>& modes) const {
    while (found > 0 && std::abs(values_(found - 1)) * kParams.range < std::abs(values_(0))) --found;
    std::vector<Eigen::Index> order(static_cast<std::size_t>(found));
    for (std::size_t k = 0; k < order.size(); ++k) order[k] = static_cast<Eigen::Index>(k);
    std::sort(order.begin(), order.end(),
              [&](Eigen::Index a, Eigen::Index b) { return 1 / values_(a) < 1 / values_(b); });
    modes.eigenvalues = values_(order).cwiseInverse();
    modes.vectors = product(space_.leftCols(size_), rotation_(Eigen::all, order));
  }

  const ShiftInverse<Scalar>& inverse_;
  Weight<Scalar> weight_;
  Eigen::Index count_;
  double tolerance_;
  Status status_ = Status::converged;
  Eigen::Index block_size_, limit_, most_, solves_ = 0, last_ = 0, size_ = 0;
  Eigen::Index coupled_ = 0;         // first column of the space that the image of the next block may overlap with
  Dense<Scalar> space_, projected_;  // V, its first size_ columns, and V^H M (K - sigma M)^{-1} M V
  Orthonormal<Scalar> block_;        // the next one
  Eigen::VectorXd values_;
  Dense<Scalar> rotation_, coupling_;
};

}  // namespace

template <class Scalar>
Modes<Scalar> nearest_modes(const ShiftInverse<Scalar>& inverse, const Eigen::SparseMatrix<Scalar>& mass,
                            const ModesOptions& options) {
  assert(options.count >= 1 && options.count <= inverse.rows && mass.rows() == inverse.rows);
  Modes<Scalar> modes = Krylov<Scalar>(inverse, mass, options).run();
  modes.shift = options.shift;
  modes.eigenvalues.array() += options.shift;
  return modes;
}

template Modes<double> nearest_modes(const ShiftInverse<double>&, const Eigen::SparseMatrix<double>&,
                                     const ModesOptions&);
template Modes<std::complex<double>> nearest_modes(const ShiftInverse<std::complex<double>>&,
                                                   const Eigen::SparseMatrix<std::complex<double>>&,
                                                   const ModesOptions&);

}  // namespace dovetail::numerics
