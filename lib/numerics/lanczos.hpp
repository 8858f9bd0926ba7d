#pragma once

#include <Eigen/Core>
#include <functional>

#include "core/status.hpp"

namespace dovetail::numerics {

/// y = A x of contiguous real vectors, as Spectra asks for it.
struct RealOperator {
  using Scalar = double;
  Eigen::Index size = 0;
  std::function<void(const double* x, double* y)> apply;

  [[nodiscard]] Eigen::Index rows() const { return size; }
  [[nodiscard]] Eigen::Index cols() const { return size; }
  void set_shift(double) {}  // factors hold it
  void perform_op(const double* x, double* y) const { apply(x, y); }
};

struct LanczosOptions {
  Eigen::Index count = 1;
  Eigen::Index vectors = 20;   // of the Krylov space
  Eigen::Index restarts = 10;  // at most
  double tolerance = 1e-11;
};

struct LanczosPairs {
  Status status = Status::iteration_limit;
  Eigen::VectorXd values;   // 1/theta, by increasing magnitude
  Eigen::MatrixXd vectors;  // [n, count]
};

/// The largest eigenvalues theta of A M by one run of Spectra's implicitly restarted Lanczos method: A symmetric, M
/// positive semi-definite. `iteration_limit` when it ends before, for whatever reason it gives.
[[nodiscard]] LanczosPairs lanczos(RealOperator inverse, const RealOperator& mass, const double* start,
                                   const LanczosOptions& options);

}  // namespace dovetail::numerics
