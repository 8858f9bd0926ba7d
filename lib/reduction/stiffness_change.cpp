#include "reduction/stiffness_change.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "numerics/dense_product.hpp"
#include "numerics/sparse_product.hpp"
#include "reduction/params.hpp"

namespace dovetail::reduction {

using Sparse = Eigen::SparseMatrix<double>;

namespace {

/// Those of a matrix that are not negligible.
std::vector<int> rows_that_count(const Sparse& matrix) {
  Eigen::VectorXd largest = Eigen::VectorXd::Zero(matrix.cols());
  for (Eigen::Index column = 0; column < matrix.outerSize(); ++column)
    for (Sparse::InnerIterator entry(matrix, column); entry; ++entry)
      largest(column) = std::max(largest(column), std::abs(entry.value()));
  const double negligible = ChangeParams{}.negligible * largest.maxCoeff();
  std::vector<int> rows;
  for (Eigen::Index column = 0; column < matrix.cols(); ++column)
    if (largest(column) > negligible) rows.push_back(static_cast<int>(column));
  return rows;
}

/// A symmetric matrix on some of its rows.
Eigen::SparseMatrix<double, Eigen::RowMajor> on_rows(const Sparse& matrix, const std::vector<int>& rows) {
  std::vector<int> place(static_cast<std::size_t>(matrix.cols()), -1);
  for (std::size_t i = 0; i < rows.size(); ++i) place[static_cast<std::size_t>(rows[i])] = static_cast<int>(i);
  std::vector<Eigen::Triplet<double>> entries;
  for (const int column : rows)
    for (Sparse::InnerIterator entry(matrix, column); entry; ++entry) {
      // Of a row left out, on the diagonal: a stress does nothing where bodies only move along.
      const int row = place[static_cast<std::size_t>(entry.row())], here = place[static_cast<std::size_t>(column)];
      entries.emplace_back(row >= 0 ? row : here, here, entry.value());
    }
  const auto r = static_cast<Eigen::Index>(rows.size());
  Eigen::SparseMatrix<double, Eigen::RowMajor> result(r, r);
  result.setFromTriplets(entries.begin(), entries.end());
  return result;
}

}  // namespace

StiffnessChange stiffness_change(const ResidualFlexibility& structure, Sparse change, const Eigen::MatrixXd& forced) {
  StiffnessChange result;
  result.whole.swap(change);
  const Eigen::MatrixXd& phi = structure.basis().vectors;
  const Eigen::MatrixXd on_phi = numerics::symmetric_product(result.whole, phi);
  const Eigen::MatrixXd on_basis = numerics::transposed_product(phi, on_phi);
  result.on_basis = 0.5 * (on_basis + on_basis.transpose());
  // Fields of contact forces decay: of them the rows count where the change is not negligible.
  const std::vector<int> rows = rows_that_count(result.whole);
  result.on_rows = on_rows(result.whole, rows);
  result.fields = forced(rows, Eigen::all).transpose();
  result.of_basis = on_phi(rows, Eigen::all);
  return result;
}

Eigen::MatrixXd StiffnessChange::on_contact(const Sparse& average) const {
  const Eigen::Index nc = average.rows(), m = on_basis.rows();
  const Eigen::MatrixXd x =
      numerics::product(Eigen::SparseMatrix<double, Eigen::RowMajor>(average), fields).transpose();
  const Eigen::MatrixXd changed = numerics::product(on_rows, numerics::Rows(x));
  Eigen::MatrixXd result(nc + m, nc + m);
  result.topLeftCorner(nc, nc) = numerics::transposed_product(x, changed);
  result.topRightCorner(nc, m) = numerics::transposed_product(x, of_basis);
  result.bottomLeftCorner(m, nc) = result.topRightCorner(nc, m).transpose();
  result.bottomRightCorner(m, m) = on_basis;
  return result;
}

}  // namespace dovetail::reduction
