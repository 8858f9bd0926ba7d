#include <algorithm>
#include <vector>

#include "fem/constraints.hpp"

namespace dovetail::fem {

namespace {

/// A column of T^H K T in the making: sums into a dense accumulator, of which only what is touched is looked at.
template <class Scalar>
class ColumnSum {
 public:
  explicit ColumnSum(Eigen::Index size)
      : sum_(static_cast<std::size_t>(size)), last_(static_cast<std::size_t>(size), -1) {}

  void begin(int column) {
    column_ = column;
    sorted_ = true;
    touched_.clear();
  }
  void add(int row, Scalar value) {
    if (row < column_) return;  // the lower triangle only
    const auto i = static_cast<std::size_t>(row);
    if (last_[i] == column_) {
      sum_[i] += value;
      return;
    }
    sorted_ = sorted_ && (touched_.empty() || row > touched_.back());
    last_[i] = column_;
    sum_[i] = value;
    touched_.push_back(row);
  }
  void append_to(Eigen::SparseMatrix<Scalar>& lower) {
    if (!sorted_) std::ranges::sort(touched_);
    lower.startVec(column_);
    for (int i : touched_) {
      const Scalar value = sum_[static_cast<std::size_t>(i)];
      lower.insertBack(i, column_) = i == column_ ? Scalar(Eigen::numext::real(value)) : value;
    }
  }

 private:
  int column_ = -1;
  bool sorted_ = true;
  std::vector<Scalar> sum_;
  std::vector<int> last_, touched_;
};

/// Where the only entry of a row is, if that is 1; else -1.
template <class Scalar>
std::vector<int> renumbering(const Eigen::SparseMatrix<Scalar, Eigen::RowMajor>& t) {
  std::vector<int> target(static_cast<std::size_t>(t.rows()), -1);
  for (Eigen::Index row = 0; row < t.rows(); ++row) {
    const int first = t.outerIndexPtr()[row];
    if (t.outerIndexPtr()[row + 1] == first + 1 && t.valuePtr()[first] == Scalar(1))
      target[static_cast<std::size_t>(row)] = t.innerIndexPtr()[first];
  }
  return target;
}

}  // namespace

template <class Scalar>
Eigen::SparseMatrix<Scalar> constrain(const Eigen::SparseMatrix<double>& full, const Constraints<Scalar>& constraints) {
  using Sparse = Eigen::SparseMatrix<Scalar>;
  using RowOf = typename Eigen::SparseMatrix<Scalar, Eigen::RowMajor>::InnerIterator;
  // Most rows of T hold a single 1, so the triple product is hardly more than a renumbering: column by column, the
  // lower triangle only, then mirrored: exactly Hermitian.
  const Eigen::SparseMatrix<Scalar, Eigen::RowMajor> rows = constraints.transformation;
  const std::vector<int> renumbered = renumbering<Scalar>(rows);
  const auto m = static_cast<int>(rows.cols());
  Sparse lower(m, m);
  lower.reserve(full.nonZeros() / 2 + m);
  ColumnSum<Scalar> sum(m);
  for (int j = 0; j < m; ++j) {
    sum.begin(j);
    for (typename Sparse::InnerIterator t(constraints.transformation, j); t; ++t)
      for (Eigen::SparseMatrix<double>::InnerIterator entry(full, t.row()); entry; ++entry) {
        const Scalar value = entry.value() * t.value();
        const int to = renumbered[static_cast<std::size_t>(entry.row())];
        if (to >= 0)
          sum.add(to, value);
        else
          for (RowOf s(rows, entry.row()); s; ++s)
            sum.add(static_cast<int>(s.col()), Eigen::numext::conj(s.value()) * value);
      }
    sum.append_to(lower);
  }
  lower.finalize();
  return Sparse(lower.template selfadjointView<Eigen::Lower>());
}

template Eigen::SparseMatrix<double> constrain(const Eigen::SparseMatrix<double>&, const Constraints<double>&);
template Eigen::SparseMatrix<std::complex<double>> constrain(const Eigen::SparseMatrix<double>&,
                                                             const Constraints<std::complex<double>>&);

}  // namespace dovetail::fem
