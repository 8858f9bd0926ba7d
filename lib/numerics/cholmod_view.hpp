#pragma once

#include <suitesparse/cholmod.h>

#include <Eigen/SparseCore>
#include <type_traits>

// Of the OpenMP runtime that CHOLMOD brings; <omp.h> is not found by every compiler.
extern "C" {
int omp_get_max_active_levels();
void omp_set_max_active_levels(int levels);
}

namespace dovetail::numerics {

template <class Scalar>
constexpr int kXtype = std::is_same_v<Scalar, double> ? CHOLMOD_REAL : CHOLMOD_COMPLEX;

/// The upper triangle of a compressed symmetric (Hermitian) matrix as CHOLMOD sees it, without a copy. Of this one it
/// makes the permuted matrix at once, of the lower one by two transpositions.
template <class Scalar>
cholmod_sparse upper_view(const Eigen::SparseMatrix<Scalar>& a) {
  cholmod_sparse view{};
  view.nrow = static_cast<std::size_t>(a.rows());
  view.ncol = static_cast<std::size_t>(a.cols());
  view.nzmax = static_cast<std::size_t>(a.nonZeros());
  // CHOLMOD reads these only; its interface has no const.
  view.p = const_cast<int*>(a.outerIndexPtr());
  view.i = const_cast<int*>(a.innerIndexPtr());
  view.x = const_cast<Scalar*>(a.valuePtr());
  view.stype = 1;
  view.itype = CHOLMOD_INT;
  view.xtype = kXtype<Scalar>;
  view.dtype = CHOLMOD_DOUBLE;
  view.sorted = 1;
  view.packed = 1;
  return view;
}

/// A supernodal factorisation that reports failures by its status alone.
inline void start_cholmod(cholmod_common& common) {
  cholmod_start(&common);
  common.supernodal = CHOLMOD_SUPERNODAL;
  common.print = 0;
  common.itype = CHOLMOD_INT;
  common.error_handler = nullptr;
}

/// The factor of a pattern, without values.
struct SymbolicFactor {
  cholmod_common common{};
  cholmod_factor* factor = nullptr;

  SymbolicFactor() { start_cholmod(common); }
  ~SymbolicFactor() {
    cholmod_free_factor(&factor, &common);
    cholmod_finish(&common);
  }
  SymbolicFactor(const SymbolicFactor&) = delete;
  SymbolicFactor& operator=(const SymbolicFactor&) = delete;
};

/// cholmod_analyze, by one thread at a time and apart from signals, as METIS may be asked; null: not enough memory.
[[nodiscard]] cholmod_factor* analyse_alone(cholmod_sparse& matrix, cholmod_common& common);

/// cholmod_factorize in one thread. CHOLMOD asks OpenMP for four threads in every supernode, whatever the user allows;
/// what they share is so little that waiting for each other nearly doubles the time of a factorisation, and candidates
/// keep the other cores busy.
inline void factorise_alone(cholmod_sparse& matrix, cholmod_factor* factor, cholmod_common& common) {
  const int levels = omp_get_max_active_levels();
  omp_set_max_active_levels(0);
  cholmod_factorize(&matrix, factor, &common);
  omp_set_max_active_levels(levels);
}

}  // namespace dovetail::numerics
