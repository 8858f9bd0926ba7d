#include "reduction/residual_flexibility.hpp"

#include <utility>

#include "numerics/dense_product.hpp"

namespace dovetail::reduction {

ResidualFlexibility::ResidualFlexibility(std::shared_ptr<const numerics::PartialCholesky> stiffness,
                                         const Eigen::SparseMatrix<double>& mass, RitzBasis basis, Eigen::Index low)
    : stiffness_(std::move(stiffness)), basis_(std::move(basis)) {
  // K x + M Phi_0 mu = B^T with Phi_0^T M x = 0, internal dofs eliminated (K_ii = L L^T, E = L^-1 (M Phi_0)_i):
  //   x_r = (S + N d^-1 N^T)^-1, mu = d^-1 N^T x_r, x_i = T x_r - L^-T E mu,
  //   N = (M Phi_0)_r + T^T (M Phi_0)_i, d = E^T E.
  const Eigen::Index contact = stiffness_->border(), internal = stiffness_->size() - contact;
  const Eigen::Index m = basis_.vectors.cols();
  constrained_ = stiffness_->schur();
  inertia_.resize(internal, low);
  multiplier_.resize(low, contact);
  if (low > 0) {
    const Eigen::MatrixXd eliminated = stiffness_->eliminate(mass * basis_.vectors.leftCols(low));
    inertia_ = eliminated.topRows(internal);
    const Eigen::MatrixXd border = eliminated.bottomRows(contact);
    inertia_gram_.emplace(numerics::transposed_product(inertia_, inertia_));
    status_ = inertia_gram_->status();
    if (status_ != Status::converged) return;
    multiplier_ = inertia_gram_->solve(border.transpose());
    numerics::add_product(border, multiplier_, constrained_);
  }
  status_ = numerics::invert_positive_definite(constrained_);
  if (status_ != Status::converged) return;

  const Eigen::MatrixXd at_contact = basis_.vectors.bottomRows(contact);
  Eigen::VectorXd softness = Eigen::VectorXd::Zero(m);
  softness.tail(m - low) = basis_.eigenvalues.tail(m - low).cwiseInverse();
  represented_ = softness.asDiagonal() * at_contact.transpose();
  flexibility_ = constrained_;
  numerics::add_product(Eigen::MatrixXd(-at_contact), represented_, flexibility_);
  // Symmetric but for rounding. In place: it is as large as the contact squared.
  for (Eigen::Index column = 0; column < contact; ++column)
    for (Eigen::Index row = column + 1; row < contact; ++row)
      flexibility_(row, column) = flexibility_(column, row) =
          0.5 * (flexibility_(row, column) + flexibility_(column, row));
  if (!flexibility_.allFinite()) status_ = Status::not_finite;
}

Eigen::MatrixXd ResidualFlexibility::field(const Eigen::Ref<const Eigen::MatrixXd>& q,
                                           const Eigen::Ref<const Eigen::MatrixXd>& f) const {
  if (f.size() == 0) return numerics::product(basis_.vectors, q);
  const Eigen::MatrixXd at_contact = numerics::product(constrained_, f);
  Eigen::MatrixXd x(stiffness_->size(), f.cols());
  x << -numerics::product(inertia_, numerics::product(multiplier_, at_contact)), at_contact;
  x = stiffness_->substitute(x);
  numerics::add_product(basis_.vectors, q - numerics::product(represented_, f), x);
  return x;
}

Eigen::MatrixXd ResidualFlexibility::response(const Eigen::Ref<const Eigen::MatrixXd>& loads) const {
  // As in the constructor, with a load: y = [g; h] eliminated, x_r = (S + N d^-1 N^T)^-1 (h - N d^-1 E^T g),
  // mu = d^-1 (E^T g + N^T x_r), z_i = g - E mu, x = substitute([z_i; x_r]).
  const Eigen::Index contact = stiffness_->border(), internal = stiffness_->size() - contact;
  const Eigen::Index low = inertia_.cols(), m = basis_.vectors.cols();
  Eigen::MatrixXd y = stiffness_->eliminate(loads);
  Eigen::MatrixXd right = y.bottomRows(contact);
  if (low > 0) {
    const Eigen::MatrixXd constrained = numerics::transposed_product(inertia_, Eigen::MatrixXd(y.topRows(internal)));
    right -= numerics::transposed_product(multiplier_, constrained);
    y.bottomRows(contact) = numerics::product(constrained_, right);
    const Eigen::MatrixXd multipliers =
        inertia_gram_->solve(constrained) + numerics::product(multiplier_, Eigen::MatrixXd(y.bottomRows(contact)));
    y.topRows(internal) -= numerics::product(inertia_, multipliers);
  } else {
    y.bottomRows(contact) = numerics::product(constrained_, right);
  }
  Eigen::MatrixXd x = stiffness_->substitute(y);
  Eigen::MatrixXd along = numerics::transposed_product(basis_.vectors, Eigen::MatrixXd(loads));
  along.topRows(low).setZero();
  along.bottomRows(m - low).array().colwise() /= basis_.eigenvalues.tail(m - low).array();
  numerics::add_product(basis_.vectors, Eigen::MatrixXd(-along), x);
  return x;
}

}  // namespace dovetail::reduction
