#include "reduction/free_modes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

#include "numerics/dense_product.hpp"
#include "numerics/dense_symmetric.hpp"
#include "numerics/nearest_modes.hpp"
#include "reduction/params.hpp"

namespace dovetail::reduction {

namespace {
constexpr FloatingParams kFloating = {};

/// Eigenpairs of the Schur complement up to `limit`, which is next to nothing beside its largest eigenvalue. They are
/// few, and far from the others: the complement, lifted a little, has a Cholesky factor, and a Krylov method on its
/// inverse finds them in a few steps, where a decomposition takes several times a factorisation.
numerics::SymmetricPairs soft_pairs(const Eigen::MatrixXd& schur, double limit, double largest) {
  const Eigen::Index n = schur.rows();
  if (n >= kFloating.krylov_from) {
    const double lift = kFloating.lift * largest;
    Eigen::MatrixXd lifted = schur;
    lifted.diagonal().array() += lift;
    const numerics::DenseCholesky factor(std::move(lifted));
    Eigen::SparseMatrix<double> identity(n, n);
    identity.setIdentity();
    const numerics::ShiftInverse<double> inverse{.rows = n,
                                                 .solve = [&](const Eigen::MatrixXd& b) { return factor.solve(b); }};
    Status status = factor.status();  // not converged: something is softer than that
    for (int count = kFloating.soft_pairs; status == Status::converged && count < n / 2; count *= 2) {
      const numerics::Modes<double> modes = numerics::nearest_modes(
          inverse, identity, {.count = count, .shift = -lift, .tolerance = kFloating.soft_tolerance});
      status = modes.status;
      const Eigen::Index found = (modes.eigenvalues.array() <= limit).count();
      if (status == Status::converged && found < modes.eigenvalues.size())
        return {.status = status, .values = modes.eigenvalues.head(found), .vectors = modes.vectors.leftCols(found)};
    }
  }
  return numerics::pairs_up_to(schur, limit);
}

}  // namespace

FloatingInverse::FloatingInverse(const numerics::PartialCholesky& stiffness, const Eigen::SparseMatrix<double>& mass)
    : stiffness_(stiffness), mass_(mass) {
  schur_inverse_ = stiffness.schur();
  const Eigen::Index contact = schur_inverse_.rows(), n = stiffness.size();
  // The largest row sum, a bound of the eigenvalues near the largest of them.
  const double largest = contact == 0 ? 0 : schur_inverse_.cwiseAbs().colwise().sum().maxCoeff();
  const double threshold = kFloating.rigid * largest;
  const numerics::SymmetricPairs low = soft_pairs(schur_inverse_, threshold, largest);
  status_ = low.status;
  if (status_ != Status::converged) return;
  negative_ = static_cast<int>((low.values.array() < -threshold).count());

  // Negative and null directions are lifted out of the way for the inversion and put back with their own inverses.
  Eigen::VectorXd inverse = low.values.cwiseInverse();
  inverse.tail(low.values.size() - negative_).setZero();
  const auto add_along = [&](const Eigen::VectorXd& values) {
    const Eigen::MatrixXd scaled = low.vectors * values.asDiagonal();
    numerics::add_product(scaled, Eigen::MatrixXd(low.vectors.transpose()), schur_inverse_);
  };
  add_along(largest - low.values.array());
  status_ = numerics::invert_positive_definite(schur_inverse_);
  if (status_ != Status::converged) return;
  if (low.values.size() > 0) add_along(inverse.array() - 1 / largest);

  Eigen::MatrixXd field = Eigen::MatrixXd::Zero(n, low.values.size() - negative_);
  field.bottomRows(contact) = low.vectors.rightCols(field.cols());
  rigid_ = stiffness.substitute(field);
  const numerics::DenseCholesky factor(numerics::transposed_product(rigid_, mass * rigid_));
  status_ = factor.status();
  if (status_ != Status::converged) return;
  rigid_ = factor.times_inverse_upper(std::move(rigid_));
  mass_rigid_ = mass * rigid_;
}

Eigen::MatrixXd FloatingInverse::apply(const Eigen::Ref<const Eigen::MatrixXd>& b) const {
  Eigen::MatrixXd load = b;
  if (rigid_.cols() > 0) load -= numerics::product(mass_rigid_, numerics::transposed_product(rigid_, load));
  Eigen::MatrixXd x = stiffness_.eliminate(load);
  const Eigen::MatrixXd condensed = x.bottomRows(stiffness_.border());
  x.bottomRows(condensed.rows()).setZero();
  numerics::add_product(schur_inverse_, condensed, x.bottomRows(condensed.rows()));
  x = stiffness_.substitute(x);
  if (rigid_.cols() > 0) x -= numerics::product(rigid_, numerics::transposed_product(mass_rigid_, x));
  return x;
}

namespace {

std::vector<Eigen::Index> by_distance_from_zero(const Eigen::VectorXd& values) {
  std::vector<Eigen::Index> order(static_cast<std::size_t>(values.size()));
  std::iota(order.begin(), order.end(), Eigen::Index{0});
  std::ranges::sort(order, {}, [&](Eigen::Index k) { return std::abs(values(k)); });
  return order;
}

}  // namespace

FreeModes free_modes(const FloatingInverse& inverse, int count, Eigen::Index limit, double tolerance) {
  const Eigen::SparseMatrix<double>& mass = inverse.mass();
  const Eigen::Index n = mass.rows();
  const Eigen::Index rigid = inverse.rigid_modes().cols();
  const numerics::ShiftInverse<double> operation{.rows = n,
                                                 .solve = [&](const Eigen::MatrixXd& b) { return inverse.apply(b); }};
  Eigen::Index wanted = std::min(std::max<Eigen::Index>(count - rigid, inverse.negative()), limit - rigid);
  const Eigen::Index most = std::max(kFloating.search_range * (wanted + 1), kFloating.search_always);
  FreeModes result;
  numerics::Modes<double> modes;
  std::vector<Eigen::Index> order;
  for (Eigen::Index asked = wanted + 1;; asked *= 2) {
    asked = std::min(asked, n);
    modes = numerics::nearest_modes(
        operation, mass,
        {.count = static_cast<int>(asked), .tolerance = tolerance, .vector_limit = kFloating.vector_limit});
    result.status = modes.status;
    if (modes.status != Status::converged) return result;
    order = by_distance_from_zero(modes.eigenvalues);
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
