#include "reduction/contact_solver.hpp"

#include <chrono>

#include "numerics/dense_product.hpp"

namespace dovetail::reduction {

Status ContactSolver::factorise(const Eigen::SparseMatrix<double>& stiffness, Eigen::Index contact_size) {
  const auto start = std::chrono::steady_clock::now();
  const Eigen::Index internal = stiffness.rows() - contact_size;
  Eigen::SparseMatrix<double> interior = stiffness.topLeftCorner(internal, internal);
  interior.makeCompressed();
  const Status status = cholesky_.factorise(interior);
  seconds_factorisation_ = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  if (status != Status::converged) return status;

  coupling_ = stiffness.topRightCorner(internal, contact_size);
  response_ = -coupling_;
  cholesky_.solve_in_place(response_);
  const Eigen::SparseMatrix<double> corner = stiffness.bottomRightCorner(contact_size, contact_size);
  const Eigen::MatrixXd schur = Eigen::MatrixXd(corner) + coupling_.transpose() * response_;
  schur_ = 0.5 * (schur + schur.transpose());
  return schur_.allFinite() ? Status::converged : Status::not_finite;
}

Eigen::MatrixXd ContactSolver::solve_internal(const Eigen::Ref<const Eigen::MatrixXd>& b) const {
  return cholesky_.solve(b);
}

Eigen::MatrixXd ContactSolver::condense(const Eigen::Ref<const Eigen::MatrixXd>& b) const {
  return b.bottomRows(contact_size()) + response_.transpose() * b.topRows(internal_size());
}

Eigen::MatrixXd ContactSolver::expand(const Eigen::Ref<const Eigen::MatrixXd>& r) const {
  Eigen::MatrixXd field = Eigen::MatrixXd::Zero(internal_size() + contact_size(), r.cols());
  numerics::add_product(response_, r, field.topRows(internal_size()));
  field.bottomRows(contact_size()) = r;
  return field;
}

}  // namespace dovetail::reduction
