#include "numerics/sparse_product.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cstddef>

#include "numerics/dense_product.hpp"

namespace dovetail::numerics {

namespace {

using SparseRows = Eigen::SparseMatrix<double, Eigen::RowMajor>;

/// Columns `first` to `first + N` of the product, from N columns that lie `stride` apart. Plain sums over N, which is
/// known, stay in registers.
template <int N>
void multiply(const Eigen::Map<const SparseRows>& a, const double* columns, Eigen::Index stride, Eigen::Index first,
              Rows& product) {
  for (Eigen::Index row = 0; row < a.rows(); ++row) {
    std::array<double, N> sum{};
    for (Eigen::Map<const SparseRows>::InnerIterator entry(a, row); entry; ++entry) {
      const double value = entry.value();
      const double* const there = columns + entry.col() * stride;
      for (std::size_t k = 0; k < N; ++k) sum[k] += value * there[k];
    }
    std::ranges::copy(sum, product.data() + row * product.cols() + first);
  }
}

Rows multiplied(const Eigen::Map<const SparseRows>& a, const Rows& x) {
  assert(a.cols() == x.rows());
  constexpr int kWide = 16;  // as many sums as there are registers for
  Rows product(a.rows(), x.cols());
  Eigen::Index first = 0;
  // Of many columns a copy of some lies together: their rows are asked for in no order, and the cache holds them.
  Eigen::Matrix<double, Eigen::Dynamic, kWide, Eigen::RowMajor> some;
  for (; first + kWide <= x.cols(); first += kWide) {
    some = x.middleCols<kWide>(first);
    multiply<kWide>(a, some.data(), kWide, first, product);
  }
  const auto narrow = [&]<int N>() {
    for (; first + N <= x.cols(); first += N) multiply<N>(a, x.data() + first, x.cols(), first, product);
  };
  narrow.operator()<8>();
  narrow.operator()<6>();  // a block of modes
  narrow.operator()<2>();
  narrow.operator()<1>();
  return product;
}

}  // namespace

Rows product(const SparseRows& a, const Rows& x) {
  return multiplied(
      {a.rows(), a.cols(), a.nonZeros(), a.outerIndexPtr(), a.innerIndexPtr(), a.valuePtr(), a.innerNonZeroPtr()}, x);
}

Eigen::MatrixXd symmetric_product(const Eigen::SparseMatrix<double>& a, const Eigen::MatrixXd& x) {
  const Eigen::Map<const SparseRows> rows(a.rows(), a.cols(), a.nonZeros(), a.outerIndexPtr(), a.innerIndexPtr(),
                                          a.valuePtr(), a.innerNonZeroPtr());
  return multiplied(rows, Rows(x));
}

Eigen::MatrixXd congruent_by_rows(const Eigen::SparseMatrix<double>& a, const Eigen::MatrixXd& x) {
  assert(a.rows() == a.cols() && a.cols() == x.cols());
  constexpr Eigen::Index kBlock = 256;  // columns of X and of X A that the cache holds
  constexpr Eigen::Index kPanels = 4;   // of the symmetric product, each up to its last column
  const Eigen::Index rows = x.rows();
  Eigen::MatrixXd left(rows, kBlock), right(rows, kBlock);
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(rows, rows);
  const auto add = [&](Eigen::Index columns) {
    for (Eigen::Index panel = 0; panel < kPanels; ++panel) {
      const Eigen::Index first = panel * rows / kPanels, end = (panel + 1) * rows / kPanels;
      add_product_transposed(left.block(first, 0, end - first, columns), right.topLeftCorner(end, columns),
                             result.block(first, 0, end - first, end));
    }
  };
  Eigen::Index columns = 0;
  for (Eigen::Index column = 0; column < a.cols(); ++column) {
    Eigen::SparseMatrix<double>::InnerIterator entry(a, column);
    if (!entry) continue;
    left.col(columns) = x.col(column);
    right.col(columns).setZero();
    // Whole columns of X one after the other: they are asked for in no order, and each is read as it lies.
    for (; entry; ++entry) right.col(columns) += entry.value() * x.col(entry.row());
    if (++columns < kBlock) continue;
    add(columns);
    columns = 0;
  }
  add(columns);
  return result.selfadjointView<Eigen::Lower>();
}

}  // namespace dovetail::numerics
