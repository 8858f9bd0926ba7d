#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <type_traits>
#include <utility>
#include <vector>

#include "numerics/nearest_modes.hpp"

namespace dovetail::numerics {

template <class Scalar>
using Column = Eigen::Matrix<Scalar, Eigen::Dynamic, 1>;
template <class Scalar>
using Columns = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>;

// What Spectra sees are real vectors: of a complex one, real and imaginary parts in turn. The dot product of two such
// vectors is the real part of x^H y.
template <class Scalar>
constexpr Eigen::Index kReals = std::is_same_v<Scalar, double> ? 1 : 2;

template <class Scalar>
Eigen::Map<const Column<Scalar>> vector_at(const double* x, Eigen::Index rows) {
  return {reinterpret_cast<const Scalar*>(x), rows};
}
template <class Scalar>
Eigen::Map<Column<Scalar>> vector_at(double* x, Eigen::Index rows) {
  return {reinterpret_cast<Scalar*>(x), rows};
}

// The modes found so far, M-orthonormal: mu = lambda - sigma, by increasing magnitude.
template <class Scalar>
struct Found {
  Status status = Status::converged;  // of a dense decomposition
  std::vector<double> values;
  Columns<Scalar> vectors, weighted;  // X and M X

  Eigen::Index size() const { return vectors.cols(); }

  // x minus its part along the modes; `along` and `against` are X and M X, or the other way round for loads.
  static void project(const Columns<Scalar>& along, const Columns<Scalar>& against, Eigen::Ref<Column<Scalar>> x) {
    if (along.cols() == 0) return;
    const Column<Scalar> overlap = against.adjoint() * x;
    x.noalias() -= along * overlap;
  }

  void sort() {
    std::vector<Eigen::Index> order(values.size());
    std::iota(order.begin(), order.end(), Eigen::Index{0});
    const auto magnitude = [this](Eigen::Index k) { return std::abs(values[static_cast<std::size_t>(k)]); };
    std::stable_sort(order.begin(), order.end(),
                     [&](Eigen::Index a, Eigen::Index b) { return magnitude(a) < magnitude(b); });
    std::vector<double> sorted;
    for (const Eigen::Index k : order) sorted.push_back(values[static_cast<std::size_t>(k)]);
    values = std::move(sorted);
    vectors = Columns<Scalar>(vectors(Eigen::all, order));
    weighted = Columns<Scalar>(weighted(Eigen::all, order));
  }

  /// Adds a mode, unless it lies in the span of the others: the i v that accompanies each v.
  void add(double value, Column<Scalar> x, const Eigen::SparseMatrix<Scalar>& mass) {
    // A genuine mode of a multiple eigenvalue may share a part with the others; its errors grow by the inverse of
    // what is left, and if it is dropped deflation finds it again.
    constexpr double kIndependent = 0.1;
    Column<Scalar> mx;
    double norm = 0;
    for (int pass = 0; pass < 2; ++pass) {
      project(vectors, weighted, x);
      mx = mass * x;
      norm = std::sqrt(std::max(0.0, std::real(x.dot(mx))));
      if (!(norm > kIndependent)) return;
      x /= Scalar(norm);
      mx /= Scalar(norm);
    }
    const Eigen::Index last = size();
    values.push_back(value);
    vectors.conservativeResize(x.size(), last + 1);
    weighted.conservativeResize(x.size(), last + 1);
    vectors.col(last) = x;
    weighted.col(last) = mx;
  }
};

// x -> M x, real and imaginary part of M apart: the first acts on both parts of x alike, the second has few entries
// (those that a cyclic phase touches), and complex products are slow.
template <class Entry>
class MassProduct {
 public:
  explicit MassProduct(const Eigen::SparseMatrix<Entry>& mass) : real_(mass.real()) {
    if constexpr (kReals<Entry> == 2) {
      imaginary_ = mass.imag();
      imaginary_.prune(0.0);
    }
  }
  void perform_op(const double* x, double* y) const {
    if constexpr (kReals<Entry> == 1) {
      vector_at<double>(y, real_.rows()).noalias() = real_ * vector_at<double>(x, real_.rows());
    } else {
      using Parts = Eigen::Matrix<double, Eigen::Dynamic, 2, Eigen::RowMajor>;
      const Eigen::Map<const Parts> from(x, real_.rows(), 2);
      Eigen::Map<Parts> to(y, real_.rows(), 2);
      to.noalias() = real_ * from;
      to.col(0) -= imaginary_ * from.col(1);
      to.col(1) += imaginary_ * from.col(0);
    }
  }

 private:
  Eigen::SparseMatrix<double, Eigen::RowMajor> real_, imaginary_;
};

// b -> scale P (K - sigma M)^{-1} P^H b with P = I - X (M X)^H, X the modes found: their eigenvalues become zero.
template <class Entry>
class DeflatedInverse {
 public:
  DeflatedInverse(const ShiftInverse<Entry>& inverse, const Found<Entry>& found, double scale)
      : inverse_(inverse), found_(found), scale_(scale), load_(inverse.rows) {}
  Eigen::Index rows() const { return kReals<Entry> * inverse_.rows; }
  void perform_op(const double* b, double* x) const {
    load_ = vector_at<Entry>(static_cast<const double*>(b), inverse_.rows);
    Found<Entry>::project(found_.weighted, found_.vectors, load_);
    Eigen::Map<Column<Entry>> result = vector_at<Entry>(x, inverse_.rows);
    inverse_.perform_op(load_.data(), result.data());
    Found<Entry>::project(found_.vectors, found_.weighted, result);
    result *= scale_;
  }

 private:
  const ShiftInverse<Entry>& inverse_;
  const Found<Entry>& found_;
  double scale_;
  mutable Column<Entry> load_;  // scratch
};

}  // namespace dovetail::numerics
