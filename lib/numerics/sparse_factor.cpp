#include "numerics/sparse_factor.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstring>
#include <stdexcept>

#include "core/interruption.hpp"
#include "numerics/cholmod_view.hpp"
#include "numerics/params.hpp"

namespace dovetail::numerics {

namespace {

template <class Scalar>
cholmod_dense dense_view(const Scalar* values, Eigen::Index rows, Eigen::Index columns) {
  cholmod_dense view{};
  view.nrow = static_cast<std::size_t>(rows);
  view.ncol = static_cast<std::size_t>(columns);
  view.nzmax = view.nrow * view.ncol;
  view.d = view.nrow;
  view.x = const_cast<Scalar*>(values);
  view.xtype = kXtype<Scalar>;
  view.dtype = CHOLMOD_DOUBLE;
  return view;
}

}  // namespace

template <class Scalar>
struct SparseCholesky<Scalar>::State {
  cholmod_common common{};
  cholmod_factor* factor = nullptr;
  cholmod_dense *x = nullptr, *y = nullptr, *e = nullptr;  // workspaces kept between solves
  Eigen::Index entries = -1;
  bool factorised = false;

  State() { start_cholmod(common); }
  ~State() {
    cholmod_free_dense(&x, &common);
    cholmod_free_dense(&y, &common);
    cholmod_free_dense(&e, &common);
    cholmod_free_factor(&factor, &common);
    cholmod_finish(&common);
  }
  State(const State&) = delete;
  State& operator=(const State&) = delete;

  void solve_block(const Scalar* b, Scalar* target, Eigen::Index columns) {
    const Eigen::Index n = static_cast<Eigen::Index>(factor->n);
    cholmod_dense right = dense_view(b, n, columns);
    cholmod_solve2(CHOLMOD_A, factor, &right, nullptr, &x, nullptr, &y, &e, &common);
    if (x == nullptr || common.status == CHOLMOD_OUT_OF_MEMORY) throw std::bad_alloc();
    std::memcpy(target, x->x, sizeof(Scalar) * static_cast<std::size_t>(n * columns));
  }
};

template <class Scalar>
SparseCholesky<Scalar>::SparseCholesky() : state_(std::make_unique<State>()) {}
template <class Scalar>
SparseCholesky<Scalar>::~SparseCholesky() = default;
template <class Scalar>
SparseCholesky<Scalar>::SparseCholesky(SparseCholesky&&) noexcept = default;
template <class Scalar>
SparseCholesky<Scalar>& SparseCholesky<Scalar>::operator=(SparseCholesky&&) noexcept = default;

template <class Scalar>
void SparseCholesky<Scalar>::analyse(const Matrix& a) {
  assert(a.rows() == a.cols() && a.isCompressed());
  State& s = *state_;
  cholmod_free_factor(&s.factor, &s.common);
  s.factorised = false;
  cholmod_sparse view = upper_view(a);
  s.factor = analyse_alone(view, s.common);
  if (s.factor == nullptr) throw std::bad_alloc();
  s.entries = a.nonZeros();
}

template <class Scalar>
void SparseCholesky<Scalar>::analyse(const Matrix& a, const SparseCholesky& ordered) {
  const cholmod_factor* other = ordered.state_->factor;
  if (other == nullptr || ordered.size() != a.rows()) return analyse(a);
  State& s = *state_;
  cholmod_free_factor(&s.factor, &s.common);
  s.factorised = false;
  cholmod_sparse view = upper_view(a);
  const auto methods = s.common.nmethods;
  const auto first = s.common.method[0].ordering;
  s.common.nmethods = 1;
  s.common.method[0].ordering = CHOLMOD_GIVEN;
  s.factor = cholmod_analyze_p(&view, static_cast<int*>(other->Perm), nullptr, 0, &s.common);
  s.common.nmethods = methods;
  s.common.method[0].ordering = first;
  if (s.factor == nullptr) throw std::bad_alloc();
  s.entries = a.nonZeros();
}

template <class Scalar>
Status SparseCholesky<Scalar>::factorise(const Matrix& a) {
  end_if_interrupted();
  State& s = *state_;
  if (s.factor == nullptr || size() != a.rows() || s.entries != a.nonZeros()) analyse(a);
  s.factorised = false;
  const Eigen::Map<const Eigen::Matrix<Scalar, Eigen::Dynamic, 1>> values(a.valuePtr(), a.nonZeros());
  // BLAS kernels let a NaN through as a pivot, so look at the input.
  if (!std::isfinite(values.cwiseAbs().sum())) return Status::not_finite;
  cholmod_sparse view = upper_view(a);
  factorise_alone(view, s.factor, s.common);
  if (s.common.status == CHOLMOD_OUT_OF_MEMORY) throw std::bad_alloc();
  if (s.common.status != CHOLMOD_OK || s.factor->minor < s.factor->n) return Status::singular;
  s.factorised = true;
  return Status::converged;
}

template <class Scalar>
typename SparseCholesky<Scalar>::Dense SparseCholesky<Scalar>::solve(const Eigen::Ref<const Dense>& b) const {
  assert(factorised() && b.rows() == size());
  const Eigen::Index n = size();
  Dense x(n, b.cols());
  Dense gathered;  // only when the columns of b are not contiguous
  for (Eigen::Index first = 0; first < b.cols(); first += FactorParams{}.columns) {
    const Eigen::Index columns = std::min(FactorParams{}.columns, b.cols() - first);
    const Scalar* source = b.data() + first * b.outerStride();
    if (b.outerStride() != n && columns > 1) {
      gathered = b.middleCols(first, columns);
      source = gathered.data();
    }
    state_->solve_block(source, x.data() + first * n, columns);
  }
  return x;
}

template <class Scalar>
void SparseCholesky<Scalar>::solve(const Scalar* b, Scalar* x) const {
  assert(factorised());
  state_->solve_block(b, x, 1);
}

template <class Scalar>
bool SparseCholesky<Scalar>::factorised() const {
  return state_->factorised;
}

template <class Scalar>
Eigen::Index SparseCholesky<Scalar>::size() const {
  return state_->factor == nullptr ? 0 : static_cast<Eigen::Index>(state_->factor->n);
}

template <class Scalar>
double SparseCholesky<Scalar>::reciprocal_condition() const {
  assert(factorised());
  return cholmod_rcond(state_->factor, &state_->common);
}

template <class Scalar>
double SparseCholesky<Scalar>::factor_entries() const {
  return state_->common.lnz;
}

template class SparseCholesky<double>;
template class SparseCholesky<std::complex<double>>;

}  // namespace dovetail::numerics
