#include "numerics/nearest_modes.hpp"

#include <Spectra/SymGEigsShiftSolver.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <new>
#include <numeric>
#include <random>
#include <stdexcept>
#include <type_traits>
#include <vector>

namespace dovetail::numerics {

namespace {

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
  Eigen::Index rows() const { return kReals<Entry> * real_.rows(); }
  Eigen::Index cols() const { return rows(); }
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
  using Scalar = double;
  DeflatedInverse(const ShiftInverse<Entry>& inverse, const Found<Entry>& found, double scale)
      : inverse_(inverse), found_(found), scale_(scale), load_(inverse.rows) {}
  Eigen::Index rows() const { return kReals<Entry> * inverse_.rows; }
  Eigen::Index cols() const { return rows(); }
  void set_shift(double) {}  // the factors hold it
  void perform_op(const double* b, double* x) {
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
  Column<Entry> load_;
};

struct RunOptions {
  Eigen::Index count = 1;
  Eigen::Index vectors = 20;   // of the Krylov space
  Eigen::Index restarts = 10;  // at most
  double tolerance = 1e-11;
  unsigned seed = 1;
};

template <class Entry>
struct Run {
  Status status = Status::iteration_limit;
  Eigen::VectorXd values;  // lambda - sigma, by increasing magnitude
  Columns<Entry> vectors;
};

template <class Entry>
Column<Entry> start_vector(Eigen::Index rows, unsigned seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> uniform(-1, 1);
  Column<Entry> start(rows);
  double* reals = reinterpret_cast<double*>(start.data());
  for (Eigen::Index k = 0; k < kReals<Entry> * rows; ++k) reals[k] = uniform(random);
  return start;
}

// One run of Spectra on what is left of the problem.
template <class Entry>
Run<Entry> run_spectra(const ShiftInverse<Entry>& inverse, const Eigen::SparseMatrix<Entry>& mass,
                       const MassProduct<Entry>& mass_product, const Found<Entry>& found, const RunOptions& options) {
  Run<Entry> run;
  const Eigen::Index n = mass.rows();
  const auto norm = [&](const Column<Entry>& x) { return std::sqrt(std::max(0.0, std::real(x.dot(mass * x)))); };

  const Column<Entry> start = start_vector<Entry>(n, options.seed);
  double scale = found.size() == 0 ? 0 : std::abs(found.values.back());
  // Spectra compares Ritz values and residuals with absolute numbers near rounding: the operator is scaled. The
  // quotient of a random vector is below its largest eigenvalue by no more than some square root of n.
  if (scale == 0) {
    Column<Entry> image(n);
    inverse.perform_op((mass * start).eval().data(), image.data());
    scale = norm(start) / norm(image);
    if (!(std::isfinite(scale) && scale > 0)) {
      run.status = Status::not_finite;
      return run;
    }
  }

  DeflatedInverse<Entry> operation(inverse, found, scale);
  Spectra::SymGEigsShiftSolver<DeflatedInverse<Entry>, const MassProduct<Entry>, Spectra::GEigsMode::ShiftInvert>
      solver(operation, mass_product, options.count, std::min(options.vectors, operation.rows()), 0.0);
  try {
    solver.init(reinterpret_cast<const double*>(start.data()));
    solver.compute(Spectra::SortRule::LargestMagn, options.restarts, options.tolerance,
                   Spectra::SortRule::SmallestMagn);
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception&) {  // its own iterations failed
    return run;
  }
  run.values = solver.eigenvalues() * scale;
  const Eigen::MatrixXd reals = solver.eigenvectors();
  run.vectors.resize(n, reals.cols());
  for (Eigen::Index k = 0; k < reals.cols(); ++k) run.vectors.col(k) = vector_at<Entry>(reals.col(k).data(), n);
  if (!run.values.allFinite() || !reals.allFinite())
    run.status = Status::not_finite;
  else if (run.values.size() == options.count)
    run.status = Status::converged;
  return run;
}

// All pairs with 1/(lambda - sigma) != 0 of M^(1/2) (K - sigma M)^{-1} M^(1/2); works for singular mass.
template <class Entry>
Found<Entry> dense_modes(const ShiftInverse<Entry>& inverse, const Eigen::SparseMatrix<Entry>& mass) {
  const Eigen::SelfAdjointEigenSolver<Columns<Entry>> spectrum{Columns<Entry>(mass)};
  // Rounding may leave eigenvalues of a singular mass matrix slightly below zero.
  const Eigen::VectorXd roots = spectrum.eigenvalues().cwiseMax(0).cwiseSqrt();
  const Columns<Entry> root = spectrum.eigenvectors() * roots.asDiagonal() * spectrum.eigenvectors().adjoint();
  Columns<Entry> flexible(mass.rows(), mass.rows());
  for (Eigen::Index k = 0; k < root.cols(); ++k) inverse.perform_op(root.col(k).data(), flexible.col(k).data());
  const Columns<Entry> product = root * flexible;
  const Eigen::SelfAdjointEigenSolver<Columns<Entry>> eigen(0.5 * (product + product.adjoint()));
  const Eigen::VectorXd& theta = eigen.eigenvalues();
  const double threshold = 1e-14 * theta.cwiseAbs().maxCoeff();
  std::vector<Eigen::Index> kept;
  for (Eigen::Index k = 0; k < theta.size(); ++k)
    if (std::abs(theta(k)) > threshold) kept.push_back(k);
  const Eigen::VectorXd values = theta(kept).cwiseInverse();
  Found<Entry> found;
  found.values.assign(values.begin(), values.end());
  found.vectors = flexible * eigen.eigenvectors()(Eigen::all, kept) * values.asDiagonal();
  found.sort();
  return found;
}

// Restarts that keep a run within `limit` applications of the operator.
Eigen::Index restarts_within(Eigen::Index limit, Eigen::Index vectors, Eigen::Index count) {
  return std::max<Eigen::Index>(1, (limit - vectors) / (vectors - count));
}

template <class Entry>
Status find_modes(const ShiftInverse<Entry>& inverse, const Eigen::SparseMatrix<Entry>& mass,
                  const ModesOptions& options, Found<Entry>& found) {
  constexpr unsigned kRounds = 12;  // every one but the last finds a mode
  // Of the look at what is left: relative accuracy of its largest value, and the vectors that usually give it.
  constexpr double kLook = 0.02;
  constexpr Eigen::Index kLookVectors = 10, kLookLimit = 120;
  // Beyond this range values are rounding.
  constexpr double kRange = 1e14;
  const MassProduct<Entry> mass_product(mass);
  const Eigen::Index wanted = options.count;
  const Eigen::Index limit = Eigen::Index{options.vector_limit} * wanted + 40;
  for (unsigned round = 0; round < kRounds; ++round) {
    const Eigen::Index missing = wanted - found.size();
    double last = 0;
    if (missing <= 0) {
      last = std::abs(found.values[static_cast<std::size_t>(wanted - 1)]);
      const Run<Entry> look = run_spectra(inverse, mass, mass_product, found,
                                          {.count = 1,
                                           .vectors = kLookVectors,
                                           .restarts = restarts_within(kLookLimit, kLookVectors, 1),
                                           .tolerance = kLook,
                                           .seed = round + 1});
      if (look.status != Status::converged) return look.status;
      if (std::abs(look.values(0)) > last * (1 + kLook)) return Status::converged;
    }
    const Eigen::Index count = std::max<Eigen::Index>(1, missing);
    // Fewer vectors mean more restarts, more vectors solves that were not needed: measured to be best.
    const Eigen::Index vectors = 2 * count + 4;
    const Run<Entry> run = run_spectra(inverse, mass, mass_product, found,
                                       {.count = count,
                                        .vectors = vectors,
                                        .restarts = restarts_within(limit, vectors, count),
                                        .tolerance = options.tolerance,
                                        .seed = round + 1});
    if (run.status != Status::converged) return run.status;
    const double nearest = std::abs(found.size() == 0 ? run.values(0) : found.values.front());
    for (Eigen::Index k = 0; k < run.values.size(); ++k) {
      if (std::abs(run.values(k)) > kRange * nearest) return Status::converged;
      found.add(run.values(k), run.vectors.col(k), mass);
    }
    found.sort();
    // A copy of the last one is no news: the set may end within a multiple eigenvalue.
    if (missing <= 0 && std::abs(run.values(0)) >= last * (1 - 1e-9)) return Status::converged;
  }
  return Status::iteration_limit;
}

}  // namespace

template <class Scalar>
Modes<Scalar> nearest_modes(const ShiftInverse<Scalar>& inverse, const Eigen::SparseMatrix<Scalar>& mass,
                            const ModesOptions& options) {
  assert(options.count >= 1 && options.count <= inverse.rows && mass.rows() == inverse.rows);
  constexpr Eigen::Index kDenseSize = 200;
  Modes<Scalar> modes;
  modes.shift = options.shift;
  Found<Scalar> found;
  found.vectors.resize(inverse.rows, 0);
  found.weighted.resize(inverse.rows, 0);
  if (inverse.rows <= kDenseSize || 3 * Eigen::Index{options.count} > inverse.rows) {
    found = dense_modes(inverse, mass);
    modes.status = found.vectors.allFinite() ? Status::converged : Status::not_finite;
  } else {
    modes.status = find_modes(inverse, mass, options, found);
  }
  if (modes.status != Status::converged) return modes;

  const Eigen::Index kept = std::min<Eigen::Index>(options.count, found.size());
  std::vector<Eigen::Index> order(static_cast<std::size_t>(kept));
  std::iota(order.begin(), order.end(), Eigen::Index{0});
  const Eigen::Map<const Eigen::VectorXd> values(found.values.data(), found.size());
  std::sort(order.begin(), order.end(), [&](Eigen::Index a, Eigen::Index b) { return values(a) < values(b); });
  modes.eigenvalues = values(order).array() + modes.shift;
  modes.vectors = found.vectors(Eigen::all, order);
  return modes;
}

template Modes<double> nearest_modes(const ShiftInverse<double>&, const Eigen::SparseMatrix<double>&,
                                     const ModesOptions&);
template Modes<std::complex<double>> nearest_modes(const ShiftInverse<std::complex<double>>&,
                                                   const Eigen::SparseMatrix<std::complex<double>>&,
                                                   const ModesOptions&);

}  // namespace dovetail::numerics
