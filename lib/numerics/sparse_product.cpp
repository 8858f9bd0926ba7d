#include "numerics/sparse_product.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cstddef>

namespace dovetail::numerics {

namespace {

using SparseRows = Eigen::SparseMatrix<double, Eigen::RowMajor>;

/// Columns `first` to `first + N` of the product. Plain sums over N, which is known, stay in registers.
template <int N>
void multiply(const Eigen::Map<const SparseRows>& a, const Rows& x, Eigen::Index first, Rows& product) {
  const double* const columns = x.data() + first;
  const Eigen::Index stride = x.cols();
  for (Eigen::Index row = 0; row < a.rows(); ++row) {
    std::array<double, N> sum{};
    for (Eigen::Map<const SparseRows>::InnerIterator entry(a, row); entry; ++entry) {
      const double value = entry.value();
      const double* const there = columns + entry.col() * stride;
      for (std::size_t k = 0; k < N; ++k) sum[k] += value * there[k];
    }
    std::ranges::copy(sum, product.data() + row * stride + first);
  }
}

Rows multiplied(const Eigen::Map<const SparseRows>& a, const Rows& x) {
  assert(a.cols() == x.rows());
  Rows product(a.rows(), x.cols());
  Eigen::Index first = 0;
  for (; first + 8 <= x.cols(); first += 8) multiply<8>(a, x, first, product);
  for (; first + 6 <= x.cols(); first += 6) multiply<6>(a, x, first, product);  // a block of modes
  for (; first + 2 <= x.cols(); first += 2) multiply<2>(a, x, first, product);
  for (; first < x.cols(); ++first) multiply<1>(a, x, first, product);
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

}  // namespace dovetail::numerics
