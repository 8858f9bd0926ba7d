#include "reduction/stiffness_change.hpp"

#include <algorithm>
#include <cmath>

#include "numerics/dense_product.hpp"
#include "numerics/sparse_product.hpp"
#include "reduction/params.hpp"

namespace dovetail::reduction {

using Sparse = Eigen::SparseMatrix<double>;

namespace {

/// A symmetric matrix without its negligible rows and columns. What they have in columns that stay goes to the
/// diagonal: a stress does nothing where bodies only move along.
Sparse what_counts(const Sparse& matrix) {
  const Eigen::Index n = matrix.cols();
  Eigen::VectorXd largest = Eigen::VectorXd::Zero(n);
  for (Eigen::Index column = 0; column < n; ++column)
    for (Sparse::InnerIterator entry(matrix, column); entry; ++entry)
      largest(column) = std::max(largest(column), std::abs(entry.value()));
  const double negligible = ChangeParams{}.negligible * largest.maxCoeff();
  Eigen::VectorXd left_out = Eigen::VectorXd::Zero(n);
  Sparse result(n, n);
  result.reserve(matrix.nonZeros());
  for (Eigen::Index column = 0; column < n; ++column) {
    result.startVec(column);
    if (largest(column) <= negligible) continue;
    for (Sparse::InnerIterator entry(matrix, column); entry; ++entry)
      if (largest(entry.row()) > negligible)
        result.insertBack(entry.row(), column) = entry.value();
      else
        left_out(column) += entry.value();
  }
  result.finalize();
  for (Eigen::Index column = 0; column < n; ++column)
    if (left_out(column) != 0) result.coeffRef(column, column) += left_out(column);
  return result;
}

}  // namespace

StiffnessChange stiffness_change(const ResidualFlexibility& structure, const Sparse& change,
                                 const Eigen::MatrixXd& forced) {
  StiffnessChange result;
  result.whole = change.pruned();
  const Eigen::MatrixXd& phi = structure.basis().vectors;
  const Eigen::Index nt = forced.rows(), m = phi.cols();
  const Eigen::MatrixXd on_phi = numerics::symmetric_product(result.whole, phi);
  result.on_trace.resize(nt + m, nt + m);
  // Fields of contact forces decay: of them the rows count where the change is not negligible.
  result.on_trace.topLeftCorner(nt, nt) = numerics::congruent_by_rows(what_counts(result.whole), forced);
  result.on_trace.topRightCorner(nt, m) = numerics::product(forced, on_phi);
  result.on_trace.bottomLeftCorner(m, nt) = result.on_trace.topRightCorner(nt, m).transpose();
  result.on_trace.bottomRightCorner(m, m) = numerics::transposed_product(phi, on_phi);
  result.on_trace = (0.5 * (result.on_trace + result.on_trace.transpose())).eval();
  return result;
}

Eigen::MatrixXd StiffnessChange::on_contact(const Sparse& average) const {
  const Eigen::Index nc = average.rows(), nt = average.cols(), m = on_trace.rows() - nt;
  const Eigen::MatrixXd averaged = average * on_trace.topRows(nt);  // [nc, nt + m]
  Eigen::MatrixXd result(nc + m, nc + m);
  result.topLeftCorner(nc, nc) = averaged.leftCols(nt) * average.transpose();
  result.topRightCorner(nc, m) = averaged.rightCols(m);
  result.bottomLeftCorner(m, nc) = averaged.rightCols(m).transpose();
  result.bottomRightCorner(m, m) = on_trace.bottomRightCorner(m, m);
  return result;
}

}  // namespace dovetail::reduction
