#include "reduction/free_modes.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

#include "numerics/dense_product.hpp"
#include "numerics/nearest_modes.hpp"

namespace dovetail::reduction {

namespace {
// S carries the rounding of the elimination, some 1e-13 of its largest entry; the rigid stiffness that
// spin softening leaves at speed is above 1e-9 of it.
constexpr double kRigidThreshold = 1e-11;
// The search for negative modes ends at this multiple of the modes first asked for.
constexpr Eigen::Index kSearchRange = 4, kSearchAlways = 100;  // but not below so many modes
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
  numerics::add_product(solver_.response(), contact, x.topRows(internal));
  x.bottomRows(contact.rows()) = contact;
  if (rigid_.cols() > 0) x -= rigid_ * (mass_rigid_.transpose() * x).eval();
  return x;
}

FreeModes free_modes(const FloatingInverse& inverse, int count, Eigen::Index limit, double tolerance) {
  const Eigen::SparseMatrix<double>& mass = inverse.mass();
  const Eigen::Index n = mass.rows();
  const Eigen::Index rigid = inverse.rigid_modes().cols();
  const numerics::ShiftInverse<double> operation{
      .rows = n,
      .perform_op =
          [&](const double* b, double* x) {
            Eigen::Map<Eigen::VectorXd>(x, n) = inverse.apply(Eigen::Map<const Eigen::VectorXd>(b, n));
          },
      .perform_block = [&](const Eigen::MatrixXd& b) { return inverse.apply(b); }};
  Eigen::Index wanted = std::min(std::max<Eigen::Index>(count - rigid, inverse.negative()), limit - rigid);
  const Eigen::Index most = std::max(kSearchRange * (wanted + 1), kSearchAlways);
  FreeModes result;
  numerics::Modes<double> modes;
  std::vector<Eigen::Index> order;  // of the modes by distance from zero
  for (Eigen::Index asked = wanted + 1;; asked *= 2) {
    asked = std::min(asked, n);
    modes = numerics::nearest_modes(operation, mass,
                                    {.count = static_cast<int>(asked), .tolerance = tolerance, .vector_limit = 20});
    result.status = modes.status;
    if (modes.status != Status::converged) return result;
    order.resize(static_cast<std::size_t>(modes.eigenvalues.size()));
    std::iota(order.begin(), order.end(), Eigen::Index{0});
    std::sort(order.begin(), order.end(), [&](Eigen::Index a, Eigen::Index b) {
      return std::abs(modes.eigenvalues(a)) < std::abs(modes.eigenvalues(b));
    });
    // Elastic modes may lie closer to zero than the negative ones; each of those must be in the basis, or
    // the residual flexibility would not be positive definite. The inertia of S tells how many there are.
    Eigen::Index last_negative = 0, negatives = 0;
    for (std::size_t k = 0; k < order.size(); ++k) {
      if (modes.eigenvalues(order[k]) < 0) {
        ++negatives;
        last_negative = static_cast<Eigen::Index>(k) + 1;
      }
    }
    wanted = std::min(std::max(wanted, last_negative), modes.eigenvalues.size());
    if (negatives >= inverse.negative() || modes.eigenvalues.size() < asked || asked == n) break;
    // A negative direction of K without mass belongs to no finite eigenvalue: no number of modes would show it.
    if (2 * asked > most) {
      result.status = Status::iteration_limit;
      return result;
    }
  }

  result.first_neglected = wanted < modes.eigenvalues.size()
                               ? modes.eigenvalues(order[static_cast<std::size_t>(wanted)])
                               : std::numeric_limits<double>::infinity();
  order.resize(static_cast<std::size_t>(wanted));
  std::sort(order.begin(), order.end());
  const Eigen::VectorXd values = modes.eigenvalues(order);
  // One more inverse iteration, of all at once: the softest, which the reduction treats as exact, gain the most.
  const Eigen::MatrixXd kept = modes.vectors(Eigen::all, order);
  const Eigen::MatrixXd refined = inverse.apply(mass * kept) * values.asDiagonal();
  const Eigen::Index negative = (values.array() < 0).count();
  result.eigenvalues.resize(rigid + wanted);
  result.eigenvalues << values.head(negative), Eigen::VectorXd::Zero(rigid), values.tail(wanted - negative);
  result.vectors.resize(n, rigid + wanted);
  result.vectors << refined.leftCols(negative), inverse.rigid_modes(), refined.rightCols(wanted - negative);
  return result;
}

}  // namespace dovetail::reduction
