#include "numerics/partial_cholesky.hpp"

#include <cblas.h>
#include <lapacke.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <new>

#include "core/interruption.hpp"
#include "numerics/cholmod_view.hpp"
#include "numerics/params.hpp"

namespace dovetail::numerics {

namespace {

using Sparse = Eigen::SparseMatrix<double>;

/// Its first `columns` columns of a supernode: a dense block, the triangle on top of the rest.
struct Panel {
  const double* values;
  const int* rows;  // [height] of the factor; the first `columns` are consecutive
  int first, columns, height;

  [[nodiscard]] int below() const { return height - columns; }
  [[nodiscard]] const double* rectangle() const { return values + columns; }
};

}  // namespace

struct PartialCholesky::Factor {
  cholmod_common common{};
  cholmod_factor* factor = nullptr;
  Eigen::Index interior = 0;

  Factor(const cholmod_factor* analysed, Eigen::Index size_of_interior) : interior(size_of_interior) {
    start_cholmod(common);
    factor = cholmod_copy_factor(const_cast<cholmod_factor*>(analysed), &common);  // which reads it only
    if (factor == nullptr) throw std::bad_alloc();
  }
  ~Factor() {
    cholmod_free_factor(&factor, &common);
    cholmod_finish(&common);
  }
  Factor(const Factor&) = delete;
  Factor& operator=(const Factor&) = delete;

  Status factorise(Sparse& upper, double& shift);

  [[nodiscard]] int supernodes() const { return static_cast<int>(factor->nsuper); }
  /// The part of a supernode that lies in the interior, or the whole of it.
  [[nodiscard]] Panel panel(int supernode, bool whole) const {
    const auto at = [supernode](const void* list, int k = 0) { return static_cast<const int*>(list)[supernode + k]; };
    const int first = at(factor->super), last = at(factor->super, 1), rows = at(factor->pi);
    const int end = whole ? last : std::min(last, static_cast<int>(interior));
    return {.values = static_cast<const double*>(factor->x) + at(factor->px),
            .rows = static_cast<const int*>(factor->s) + rows,
            .first = first,
            .columns = std::max(0, end - first),
            .height = at(factor->pi, 1) - rows};
  }
  [[nodiscard]] const int* order() const { return static_cast<const int*>(factor->Perm); }

  [[nodiscard]] Eigen::MatrixXd reversed_border() const;
  void forget_border();
  void eliminate(Eigen::MatrixXd& x) const;
  void substitute(Eigen::MatrixXd& x) const;
};

// The whole of A has no Cholesky factor, so its border gets a shift that makes S + shift I positive definite. It is
// large beside the negative part that S has in a body that floats, and no larger than the rest of S.
Status PartialCholesky::Factor::factorise(Sparse& upper, double& shift) {
  constexpr BorderParams kParams = {};
  const Eigen::Index border = upper.rows() - interior;
  for (int attempt = 0; attempt < kParams.attempts; ++attempt) {
    const double added = attempt == 0 ? shift : (kParams.growth - 1) * shift;
    for (Eigen::Index k = interior; k < upper.rows(); ++k) upper.coeffRef(k, k) += added;
    if (attempt > 0) shift *= kParams.growth;
    cholmod_sparse view = upper_view(upper);
    factorise_alone(view, factor, common);
    if (common.status == CHOLMOD_OUT_OF_MEMORY) throw std::bad_alloc();
    if (common.status == CHOLMOD_OK && factor->minor >= factor->n) return Status::converged;
    // The column that failed.
    if (border == 0 || static_cast<Eigen::Index>(factor->minor) < interior) break;
  }
  return Status::singular;
}

// The Cholesky factor of S + shift I with rows and columns in reverse order.
Eigen::MatrixXd PartialCholesky::Factor::reversed_border() const {
  const auto border = static_cast<Eigen::Index>(factor->n) - interior;
  const Eigen::Index last = static_cast<Eigen::Index>(factor->n) - 1;
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(border, border);
  for (int s = 0; s < supernodes(); ++s) {
    const Panel all = panel(s, true);
    for (int column = panel(s, false).columns; column < all.columns; ++column)
      for (int row = column; row < all.height; ++row)
        result(last - all.rows[row], last - all.first - column) = all.values[column * all.height + row];
  }
  return result;
}

// Panels of the border stand last, and are as large as the border squared.
void PartialCholesky::Factor::forget_border() {
  int kept = 0;
  while (kept < supernodes() && panel(kept, false).columns > 0) ++kept;
  const auto size = static_cast<std::size_t>(static_cast<const int*>(factor->px)[kept]);
  if (kept < supernodes() && size > 0)
    factor->x = cholmod_realloc(size, sizeof(double), factor->x, &factor->xsize, &common);
}

void PartialCholesky::Factor::eliminate(Eigen::MatrixXd& x) const {
  const auto k = static_cast<int>(x.cols()), n = static_cast<int>(x.rows());
  Eigen::MatrixXd update;
  for (int s = 0; s < supernodes(); ++s) {
    const Panel p = panel(s, false);
    if (p.columns == 0) break;
    double* top = x.data() + p.first;
    update.resize(p.below(), k);
    if (k == 1) {
      cblas_dtrsv(CblasColMajor, CblasLower, CblasNoTrans, CblasNonUnit, p.columns, p.values, p.height, top, 1);
      if (p.below() == 0) continue;
      cblas_dgemv(CblasColMajor, CblasNoTrans, p.below(), p.columns, 1.0, p.rectangle(), p.height, top, 1, 0.0,
                  update.data(), 1);
    } else {
      cblas_dtrsm(CblasColMajor, CblasLeft, CblasLower, CblasNoTrans, CblasNonUnit, p.columns, k, 1.0, p.values,
                  p.height, top, n);
      if (p.below() == 0) continue;
      cblas_dgemm(CblasColMajor, CblasNoTrans, CblasNoTrans, p.below(), k, p.columns, 1.0, p.rectangle(), p.height, top,
                  n, 0.0, update.data(), p.below());
    }
    const int* rows = p.rows + p.columns;
    for (int column = 0; column < k; ++column) {
      double* target = x.col(column).data();
      const double* source = update.col(column).data();
      for (int row = 0; row < p.below(); ++row) target[rows[row]] -= source[row];
    }
  }
}

void PartialCholesky::Factor::substitute(Eigen::MatrixXd& x) const {
  const auto k = static_cast<int>(x.cols()), n = static_cast<int>(x.rows());
  Eigen::MatrixXd known;
  for (int s = supernodes() - 1; s >= 0; --s) {
    const Panel p = panel(s, false);
    if (p.columns == 0) continue;
    double* top = x.data() + p.first;
    known.resize(p.below(), k);
    const int* rows = p.rows + p.columns;
    for (int column = 0; column < k; ++column) {
      double* target = known.col(column).data();
      const double* source = x.col(column).data();
      for (int row = 0; row < p.below(); ++row) target[row] = source[rows[row]];
    }
    if (k == 1) {
      if (p.below() > 0)
        cblas_dgemv(CblasColMajor, CblasTrans, p.below(), p.columns, -1.0, p.rectangle(), p.height, known.data(), 1,
                    1.0, top, 1);
      cblas_dtrsv(CblasColMajor, CblasLower, CblasTrans, CblasNonUnit, p.columns, p.values, p.height, top, 1);
    } else {
      if (p.below() > 0)
        cblas_dgemm(CblasColMajor, CblasTrans, CblasNoTrans, p.columns, k, p.below(), -1.0, p.rectangle(), p.height,
                    known.data(), p.below(), 1.0, top, n);
      cblas_dtrsm(CblasColMajor, CblasLeft, CblasLower, CblasTrans, CblasNonUnit, p.columns, k, 1.0, p.values, p.height,
                  top, n);
    }
  }
}

namespace {

/// Its upper triangle, in no more memory than that needs: Eigen's own takes as much as for the whole.
Sparse upper_triangle(const Sparse& a) {
  const auto count = [&](Eigen::Index column) {
    const int* const rows = a.innerIndexPtr() + a.outerIndexPtr()[column];
    const Eigen::Index stored = a.innerVector(column).nonZeros();
    return static_cast<int>(std::upper_bound(rows, rows + stored, static_cast<int>(column)) - rows);
  };
  Sparse upper(a.rows(), a.cols());
  int* const starts = upper.outerIndexPtr();
  for (Eigen::Index column = 0; column < a.cols(); ++column) starts[column + 1] = starts[column] + count(column);
  upper.resizeNonZeros(starts[a.cols()]);
  for (Eigen::Index column = 0; column < a.cols(); ++column) {
    const int from = a.outerIndexPtr()[column], stored = starts[column + 1] - starts[column];
    std::copy_n(a.innerIndexPtr() + from, stored, upper.innerIndexPtr() + starts[column]);
    std::copy_n(a.valuePtr() + from, stored, upper.valuePtr() + starts[column]);
  }
  return upper;
}

/// Entries of the border's diagonal must be there for the shift.
void hold_diagonal(Sparse& upper, Eigen::Index border) {
  const Eigen::Index first = upper.rows() - border;
  Sparse diagonal(upper.rows(), upper.cols());
  for (Eigen::Index k = first; k < upper.rows(); ++k) {
    const Sparse::ReverseInnerIterator last(upper, k);
    if (!last || last.row() != k) diagonal.insert(k, k) = 0;
  }
  if (diagonal.nonZeros() > 0) upper += diagonal;
}

}  // namespace

PartialCholesky::PartialCholesky() = default;
PartialCholesky::~PartialCholesky() = default;
PartialCholesky::PartialCholesky(PartialCholesky&&) noexcept = default;
PartialCholesky& PartialCholesky::operator=(PartialCholesky&&) noexcept = default;

Eigen::Index PartialCholesky::size() const {
  return factor_ ? static_cast<Eigen::Index>(factor_->factor->n) : 0;
}

Status PartialCholesky::factorise(const Sparse& a, Eigen::Index border, EliminationOrder* order) {
  assert(a.rows() == a.cols() && border >= 0 && border <= a.rows());
  end_if_interrupted();
  const Eigen::Index interior = a.rows() - border;
  factor_.reset();
  Sparse upper = upper_triangle(a);
  hold_diagonal(upper, border);
  const Eigen::Map<const Eigen::VectorXd> values(upper.valuePtr(), upper.nonZeros());
  // BLAS kernels let a NaN through as a pivot, so look at the input.
  if (!std::isfinite(values.cwiseAbs().sum())) return Status::not_finite;
  const double size = border > 0 ? upper.diagonal().tail(border).cwiseAbs().mean() : 0;
  double shift = size > 0 ? size : 1;

  EliminationOrder own;
  auto factor = std::make_unique<Factor>((order ? *order : own).of(upper, border)->factor, interior);
  const Status status = factor->factorise(upper, shift);
  if (status != Status::converged) return status;
  Sparse().swap(upper);
  // L L^T by LAPACK, which has U U^T: U is L in reverse order. In place: the border may be as large as the rest.
  schur_ = factor->reversed_border();
  factor->forget_border();
  const auto n = static_cast<lapack_int>(border);
  if (n > 0) LAPACKE_dlauum_work(LAPACK_COL_MAJOR, 'U', n, schur_.data(), n);
  schur_.triangularView<Eigen::StrictlyLower>() = schur_.transpose();
  std::reverse(schur_.data(), schur_.data() + schur_.size());
  schur_.diagonal().array() -= shift;
  factor_ = std::move(factor);
  return schur_.allFinite() ? Status::converged : Status::not_finite;
}

Eigen::MatrixXd PartialCholesky::eliminate(const Eigen::Ref<const Eigen::MatrixXd>& b) const {
  assert(factor_ && b.rows() == size());
  const Eigen::Map<const Eigen::VectorXi> order(factor_->order(), size());
  Eigen::MatrixXd y(b.rows(), b.cols());
  Eigen::MatrixXd block;
  for (Eigen::Index first = 0; first < b.cols(); first += FactorParams{}.columns) {
    const Eigen::Index columns = std::min(FactorParams{}.columns, b.cols() - first);
    block = b.middleCols(first, columns)(order, Eigen::all);
    factor_->eliminate(block);
    y.middleCols(first, columns) = block;
  }
  return y;
}

Eigen::MatrixXd PartialCholesky::substitute(const Eigen::Ref<const Eigen::MatrixXd>& y) const {
  assert(factor_ && y.rows() == size());
  const Eigen::Map<const Eigen::VectorXi> order(factor_->order(), size());
  Eigen::MatrixXd x(y.rows(), y.cols());
  Eigen::MatrixXd block;
  for (Eigen::Index first = 0; first < y.cols(); first += FactorParams{}.columns) {
    const Eigen::Index columns = std::min(FactorParams{}.columns, y.cols() - first);
    block = y.middleCols(first, columns);
    factor_->substitute(block);
    x.middleCols(first, columns)(order, Eigen::all) = block;
  }
  return x;
}

}  // namespace dovetail::numerics
