#include "reduction/free_modes.hpp"

#include <Spectra/SymGEigsShiftSolver.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <vector>

namespace dovetail::reduction {

namespace {
// S carries the rounding of the elimination, some 1e-13 of its largest entry; the rigid stiffness that
// spin softening leaves at speed is above 1e-9 of it.
constexpr double kRigidThreshold = 1e-11;

constexpr Eigen::Index kDenseSize = 200;
}  // namespace

FloatingInverse::FloatingInverse(const ContactSolver& solver, const Eigen::SparseMatrix<double>& mass)
    : solver_(solver), mass_(mass) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(solver.schur());
  const Eigen::VectorXd& values = eigen.eigenvalues();
  const Eigen::MatrixXd& vectors = eigen.eigenvectors();
  const double threshold = kRigidThreshold * values.cwiseAbs().maxCoeff();
  Eigen::VectorXd inverse = Eigen::VectorXd::Zero(values.size());
  std::vector<Eigen::Index> null;
  for (Eigen::Index k = 0; k < values.size(); ++k) {
    if (std::abs(values(k)) <= threshold) {
      null.push_back(k);
    } else {
      inverse(k) = 1 / values(k);
      if (values(k) < 0) ++negative_;
    }
  }
  schur_inverse_ = vectors * inverse.asDiagonal() * vectors.transpose();

  const Eigen::MatrixXd field = solver.expand(vectors(Eigen::all, null));
  const Eigen::MatrixXd inertia = field.transpose() * (mass * field);
  rigid_ = field;
  if (!null.empty()) {
    const Eigen::LLT<Eigen::MatrixXd> factor(inertia);
    rigid_ = factor.matrixU().solve<Eigen::OnTheRight>(field);
  }
  mass_rigid_ = mass * rigid_;
}

Eigen::MatrixXd FloatingInverse::apply(const Eigen::Ref<const Eigen::MatrixXd>& b) const {
  const Eigen::Index internal = solver_.internal_size();
  Eigen::MatrixXd load = b;
  if (rigid_.cols() > 0) load -= mass_rigid_ * (rigid_.transpose() * b).eval();
  Eigen::MatrixXd x(load.rows(), load.cols());
  const Eigen::MatrixXd contact = schur_inverse_ * solver_.condense(load);
  x.topRows(internal) = solver_.solve_internal(load.topRows(internal));
  x.topRows(internal).noalias() += solver_.response() * contact;
  x.bottomRows(contact.rows()) = contact;
  if (rigid_.cols() > 0) x -= rigid_ * (mass_rigid_.transpose() * x).eval();
  return x;
}

void FloatingInverse::apply(const double* b, double* x) const {
  const Eigen::Index internal = solver_.internal_size();
  const Eigen::Index contact = solver_.contact_size();
  Eigen::VectorXd load = Eigen::Map<const Eigen::VectorXd>(b, internal + contact);
  Eigen::Map<Eigen::VectorXd> result(x, internal + contact);
  if (rigid_.cols() > 0) load -= mass_rigid_ * (rigid_.transpose() * load).eval();
  const Eigen::VectorXd on_contact = load.tail(contact) + solver_.response().transpose() * load.head(internal);
  const Eigen::VectorXd displacement = schur_inverse_ * on_contact;
  solver_.solve_internal(load.data(), x);
  result.head(internal).noalias() += solver_.response() * displacement;
  result.tail(contact) = displacement;
  if (rigid_.cols() > 0) result -= rigid_ * (mass_rigid_.transpose() * result).eval();
}

namespace {

struct InverseOperator {
  using Scalar = double;
  const FloatingInverse& inverse;
  Eigen::Index rows() const { return inverse.mass().rows(); }
  Eigen::Index cols() const { return rows(); }
  void set_shift(const double&) {}
  void perform_op(const double* b, double* x) const { inverse.apply(b, x); }
};

struct MassOperator {
  using Scalar = double;
  const Eigen::SparseMatrix<double>& mass;
  Eigen::Index rows() const { return mass.rows(); }
  Eigen::Index cols() const { return mass.cols(); }
  void perform_op(const double* b, double* x) const {
    Eigen::Map<Eigen::VectorXd>(x, mass.rows()).noalias() = mass * Eigen::Map<const Eigen::VectorXd>(b, mass.rows());
  }
};

struct Pairs {
  Status status = Status::converged;
  Eigen::VectorXd values;   // 1 / lambda, largest magnitude first
  Eigen::MatrixXd vectors;  // M-orthonormal
};

// All pairs of M^(1/2) K^-1 M^(1/2) with theta = 1/lambda != 0; works for singular mass.
Pairs dense_pairs(const FloatingInverse& inverse) {
  const Eigen::Index n = inverse.mass().rows();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> mass{Eigen::MatrixXd(inverse.mass())};
  // Rounding may leave eigenvalues of a singular mass matrix slightly below zero.
  const Eigen::VectorXd roots = mass.eigenvalues().cwiseMax(0).cwiseSqrt();
  const Eigen::MatrixXd root = mass.eigenvectors() * roots.asDiagonal() * mass.eigenvectors().transpose();
  const Eigen::MatrixXd flexible = inverse.apply(root);
  const Eigen::MatrixXd product = root * flexible;
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(0.5 * (product + product.transpose()));
  std::vector<Eigen::Index> order(static_cast<std::size_t>(n));
  std::iota(order.begin(), order.end(), Eigen::Index{0});
  const Eigen::VectorXd& theta = eigen.eigenvalues();
  std::sort(order.begin(), order.end(),
            [&](Eigen::Index a, Eigen::Index b) { return std::abs(theta(a)) > std::abs(theta(b)); });
  const double threshold = 1e-14 * theta.cwiseAbs().maxCoeff();
  std::erase_if(order, [&](Eigen::Index k) { return std::abs(theta(k)) <= threshold; });
  Pairs pairs;
  pairs.values = theta(order);
  pairs.vectors = flexible * eigen.eigenvectors()(Eigen::all, order) * pairs.values.cwiseInverse().asDiagonal();
  return pairs;
}

Pairs lanczos_pairs(const FloatingInverse& inverse, Eigen::Index count, double tolerance, int restarts) {
  InverseOperator inverse_operator{inverse};
  MassOperator mass_operator{inverse.mass()};
  const Eigen::Index size = std::min(inverse.mass().rows(), std::max(2 * count + 1, count + 20));
  Pairs pairs;
  try {
    Spectra::SymGEigsShiftSolver<InverseOperator, MassOperator, Spectra::GEigsMode::ShiftInvert> solver(
        inverse_operator, mass_operator, count, size, 0.0);
    solver.init();
    solver.compute(Spectra::SortRule::LargestMagn, restarts, tolerance, Spectra::SortRule::SmallestMagn);
    if (solver.info() != Spectra::CompInfo::Successful) {
      pairs.status = Status::iteration_limit;
      return pairs;
    }
    pairs.values = solver.eigenvalues().cwiseInverse();
    pairs.vectors = solver.eigenvectors();
    if (!pairs.vectors.allFinite()) pairs.status = Status::not_finite;
  } catch (const std::exception&) {
    pairs.status = Status::stalled;
  }
  return pairs;
}

}  // namespace

FreeModes free_modes(const FloatingInverse& inverse, int count, Eigen::Index limit, double tolerance, int restarts) {
  const Eigen::Index n = inverse.mass().rows();
  const Eigen::Index rigid = inverse.rigid_modes().cols();
  Eigen::Index wanted = std::min(std::max<Eigen::Index>(count - rigid, inverse.negative()), limit - rigid);
  FreeModes result;
  Pairs pairs;
  for (Eigen::Index asked = wanted + 1;; asked *= 2) {
    const bool dense = n <= kDenseSize || 3 * asked > n;
    pairs = dense ? dense_pairs(inverse) : lanczos_pairs(inverse, asked, tolerance, restarts);
    result.status = pairs.status;
    if (pairs.status != Status::converged) return result;
    // Elastic modes may lie closer to zero than the negative ones; each of those must be in the basis, or
    // the residual flexibility would not be positive definite.
    Eigen::Index last_negative = 0, negatives = 0;
    for (Eigen::Index k = 0; k < pairs.values.size(); ++k) {
      if (pairs.values(k) < 0) {
        ++negatives;
        last_negative = k + 1;
      }
    }
    wanted = std::min(std::max(wanted, last_negative), pairs.values.size());
    if (negatives >= inverse.negative() || dense) break;
  }

  result.first_neglected =
      wanted < pairs.values.size() ? 1 / pairs.values(wanted) : std::numeric_limits<double>::infinity();
  result.eigenvalues = Eigen::VectorXd::Zero(rigid + wanted);
  result.vectors.resize(n, rigid + wanted);
  result.vectors << inverse.rigid_modes(), pairs.vectors.leftCols(wanted);
  result.eigenvalues.tail(wanted) = pairs.values.head(wanted).cwiseInverse();
  std::vector<Eigen::Index> order(static_cast<std::size_t>(rigid + wanted));
  std::iota(order.begin(), order.end(), Eigen::Index{0});
  std::sort(order.begin(), order.end(),
            [&](Eigen::Index a, Eigen::Index b) { return result.eigenvalues(a) < result.eigenvalues(b); });
  const Eigen::VectorXd sorted_values = result.eigenvalues(order);
  const Eigen::MatrixXd sorted_vectors = result.vectors(Eigen::all, order);
  result.eigenvalues = sorted_values;
  result.vectors = sorted_vectors;
  return result;
}

}  // namespace dovetail::reduction
