#pragma once

#include <suitesparse/cholmod.h>

#include <Eigen/SparseCore>
#include <type_traits>

namespace dovetail::numerics {

template <class Scalar>
constexpr int kXtype = std::is_same_v<Scalar, double> ? CHOLMOD_REAL : CHOLMOD_COMPLEX;

/// The lower triangle of a compressed symmetric (Hermitian) matrix as CHOLMOD sees it, without a copy.
template <class Scalar>
cholmod_sparse lower_view(const Eigen::SparseMatrix<Scalar>& a) {
  cholmod_sparse view{};
  view.nrow = static_cast<std::size_t>(a.rows());
  view.ncol = static_cast<std::size_t>(a.cols());
  view.nzmax = static_cast<std::size_t>(a.nonZeros());
  // CHOLMOD reads these only; its interface has no const.
  view.p = const_cast<int*>(a.outerIndexPtr());
  view.i = const_cast<int*>(a.innerIndexPtr());
  view.x = const_cast<Scalar*>(a.valuePtr());
  view.stype = -1;
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

}  // namespace dovetail::numerics
