#pragma once

#include <string>

#include "core/status.hpp"
#include "reduction/full_model.hpp"
#include "reduction/recovery.hpp"
#include "reduction/reduced_model.hpp"

namespace dovetail::reduction {

/// The quasi-static model on the contact dofs alone and the way back, u = u_0 + T r.
struct StaticCondensation {
  Status status = Status::converged;  ///< `singular`: stiffness with fixed contact is not positive definite
  ReducedModel model;                 ///< contact dofs only (node by node: N, T1[, T2]); mass and damping zero
  Recovery recovery;                  ///< T r, offset u_0 [n] (response to the static force at r = 0)
};

/// S = K_rr - K_ri K_ii^-1 K_ir, f_r - K_ri K_ii^-1 f_i (exact, for all loads). An output y = c^T u becomes
/// c^T u_0 + (T^T c)^T r: the model holds T^T c, the constant is left to `recovery`.
/// Throws InputError for inconsistent sizes. Cost: one sparse Cholesky factorisation, two solves per load.
[[nodiscard]] StaticCondensation condense_statically(const FullModel& full);

/// The same with other contact nodes on the trace that `trace` has as contact, u = A v (see reduce): the trace is
/// free to deform between them. Dense algebra of the trace's size and a solve.
[[nodiscard]] StaticCondensation on_contact(const StaticCondensation& trace, const Eigen::SparseMatrix<double>& average,
                                            ContactNodes contact);

}  // namespace dovetail::reduction
