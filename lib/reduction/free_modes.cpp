#include "reduction/free_modes.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>
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
  const Eigen::MatrixXd held = solver_.solve_internal(load.topRows(internal));
  // The load on the contact dofs through the sparse coupling: cheaper than through T once `held` is known.
  const Eigen::MatrixXd contact =
      schur_inverse_ * (load.bottomRows(solver_.contact_size()) - solver_.coupling().transpose() * held);
  x.topRows(internal) = held;
  x.topRows(internal).noalias() += solver_.response() * contact;
  x.bottomRows(contact.rows()) = contact;
  if (rigid_.cols() > 0) x -= rigid_ * (mass_rigid_.transpose() * x).eval();
  return x;
}

namespace {

struct Pairs {
  Status status = Status::converged;
  Eigen::VectorXd values;   // 1 / lambda, largest magnitude first
  Eigen::MatrixXd vectors;  // M-orthonormal
};

std::vector<Eigen::Index> by_magnitude(const Eigen::VectorXd& theta) {
  std::vector<Eigen::Index> order(static_cast<std::size_t>(theta.size()));
  std::iota(order.begin(), order.end(), Eigen::Index{0});
  std::sort(order.begin(), order.end(),
            [&](Eigen::Index a, Eigen::Index b) { return std::abs(theta(a)) > std::abs(theta(b)); });
  return order;
}

// All pairs of M^(1/2) K^-1 M^(1/2) with theta = 1/lambda != 0; works for singular mass.
Pairs dense_pairs(const FloatingInverse& inverse) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> mass{Eigen::MatrixXd(inverse.mass())};
  // Rounding may leave eigenvalues of a singular mass matrix slightly below zero.
  const Eigen::VectorXd roots = mass.eigenvalues().cwiseMax(0).cwiseSqrt();
  const Eigen::MatrixXd root = mass.eigenvectors() * roots.asDiagonal() * mass.eigenvectors().transpose();
  const Eigen::MatrixXd flexible = inverse.apply(root);
  const Eigen::MatrixXd product = root * flexible;
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(0.5 * (product + product.transpose()));
  const Eigen::VectorXd& theta = eigen.eigenvalues();
  std::vector<Eigen::Index> order = by_magnitude(theta);
  const double threshold = 1e-14 * theta.cwiseAbs().maxCoeff();
  std::erase_if(order, [&](Eigen::Index k) { return std::abs(theta(k)) <= threshold; });
  Pairs pairs;
  pairs.values = theta(order);
  pairs.vectors = flexible * eigen.eigenvectors()(Eigen::all, order) * pairs.values.cwiseInverse().asDiagonal();
  return pairs;
}

// M-orthonormal columns with the span of `block`; nearly dependent ones are dropped.
Eigen::MatrixXd orthonormal(const Eigen::SparseMatrix<double>& mass, const Eigen::MatrixXd& block) {
  Eigen::MatrixXd columns = block;
  for (int pass = 0; pass < 2; ++pass) {  // the second pass removes what rounding left in the first
    const Eigen::MatrixXd gram = columns.transpose() * (mass * columns);
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(0.5 * (gram + gram.transpose()));
    const Eigen::VectorXd& squares = eigen.eigenvalues();
    const double threshold = 1e-22 * squares.cwiseAbs().maxCoeff();
    const Eigen::Index rank = (squares.array() > threshold).count();
    columns = (columns * eigen.eigenvectors().rightCols(rank)).eval() *
              squares.tail(rank).cwiseSqrt().cwiseInverse().asDiagonal();
  }
  return columns;
}

// Block Lanczos on K^-1 M with full re-orthogonalisation in the M-inner product, without restarts. Blocks read
// the sparse factors once for several vectors, which is most of the cost.
Pairs lanczos_pairs(const FloatingInverse& inverse, Eigen::Index count, double tolerance) {
  constexpr Eigen::Index kBlock = 8;
  // The softest pairs enter the reduction as exact eigenpairs; they converge long before the last ones.
  constexpr double kSoft = 1e-2, kSoftTolerance = 1e-11;
  const Eigen::SparseMatrix<double>& mass = inverse.mass();
  const Eigen::Index n = mass.rows();
  const Eigen::Index most = std::min(n, 12 * count + 200);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform(-1, 1);
  const Eigen::MatrixXd start = Eigen::MatrixXd::NullaryExpr(n, kBlock, [&] { return uniform(random); });
  Eigen::MatrixXd block = orthonormal(mass, inverse.apply(start));

  Pairs pairs;
  Eigen::MatrixXd space(n, most + kBlock), mass_space(n, most + kBlock);
  Eigen::MatrixXd projected = Eigen::MatrixXd::Zero(most + kBlock, most + kBlock);  // V^T M K^-1 M V
  Eigen::Index size = 0;
  while (block.cols() > 0 && size + block.cols() <= most) {
    const Eigen::Index width = block.cols();
    space.middleCols(size, width) = block;
    mass_space.middleCols(size, width).noalias() = mass * block;
    size += width;
    Eigen::MatrixXd next = inverse.apply(mass_space.middleCols(size - width, width));
    for (int pass = 0; pass < 2; ++pass) {
      const Eigen::MatrixXd part = mass_space.leftCols(size).transpose() * next;
      next.noalias() -= space.leftCols(size) * part;
      projected.block(0, size - width, size, width) += part;
    }
    projected.block(size - width, 0, width, size) = projected.block(0, size - width, size, width).transpose();
    // |next y| is the residual of a Ritz pair whose last components are y.
    const Eigen::MatrixXd gram = next.transpose() * (mass * next);
    if (!gram.allFinite()) {
      pairs.status = Status::not_finite;
      return pairs;
    }
    if (size >= count) {
      const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> ritz(projected.topLeftCorner(size, size));
      std::vector<Eigen::Index> order = by_magnitude(ritz.eigenvalues());
      order.resize(static_cast<std::size_t>(count));
      const Eigen::VectorXd theta = ritz.eigenvalues()(order);
      const Eigen::MatrixXd y = ritz.eigenvectors()(Eigen::all, order);
      const double last = std::abs(theta(count - 1));
      bool converged = true;
      for (Eigen::Index k = 0; k < count && converged; ++k) {
        const Eigen::VectorXd tail = y.col(k).tail(width);
        const double residual = std::sqrt(std::max(0.0, tail.dot(gram * tail))) / std::abs(theta(k));
        converged = residual <= (kSoft * std::abs(theta(k)) >= last ? kSoftTolerance : tolerance);
      }
      if (converged) {
        pairs.values = theta;
        pairs.vectors = space.leftCols(size) * y;
        return pairs;
      }
    }
    block = orthonormal(mass, next);
    // The new block is orthogonal to the space only as far as `next` was large: repeat on unit vectors.
    block -= space.leftCols(size) * (mass_space.leftCols(size).transpose() * block).eval();
    block = orthonormal(mass, block);
  }
  pairs.status = Status::iteration_limit;
  return pairs;
}

}  // namespace

FreeModes free_modes(const FloatingInverse& inverse, int count, Eigen::Index limit, double tolerance) {
  const Eigen::Index n = inverse.mass().rows();
  const Eigen::Index rigid = inverse.rigid_modes().cols();
  Eigen::Index wanted = std::min(std::max<Eigen::Index>(count - rigid, inverse.negative()), limit - rigid);
  FreeModes result;
  Pairs pairs;
  for (Eigen::Index asked = wanted + 1;; asked *= 2) {
    const bool dense = n <= kDenseSize || 3 * asked > n;
    pairs = dense ? dense_pairs(inverse) : lanczos_pairs(inverse, asked, tolerance);
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
