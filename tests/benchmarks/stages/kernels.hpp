#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <map>
#include <string>
#include <vector>

#include "tests/benchmarks/stages/measurement.hpp"

namespace dovetail::benchmarks {

/// Work that no stage can do without, asked of the libraries directly.
struct Kernel {
  Work work;
  double units = 1;   ///< that one run does
  std::string words;  ///< what `per` units are, for people
  double per = 0;     ///< 0: those of one run
};

/// Units of kernels, by name, that a stage cannot do without.
using Needs = std::map<std::string, double>;

// Names of kernels.
inline constexpr const char* kOrder = "order";                  ///< of elimination, with the analysis
inline constexpr const char* kFactorisation = "factorisation";  ///< sparse Cholesky factors, order and analysis kept
inline constexpr const char* kBackSolve = "back_solve";         ///< one column of many
inline constexpr const char* kDenseLu = "dense_lu";             ///< one operation of it
inline constexpr const char* kDenseInverse = "dense_inverse";   ///< at the size of the trace, or one operation of it
inline constexpr const char* kMarch = "march";                  ///< one operation as budgets count them
inline constexpr const char* kTraffic = "memory_traffic";       ///< one byte read or written

/// Sizes at which kernels are run.
struct KernelParams {
  Eigen::Index columns = 64;        ///< back-solves at once: times are flat from 16 on
  Eigen::Index streamed = 1 << 22;  ///< numbers in each of two arrays, beyond the caches
  /// Mass that is added to a stiffness, over Omega^2: a blade that floats in its slot is softened by Omega^2 times the
  /// radius over its own size, and by the stress of its pull as much. Smaller: no positive definite matrix to
  /// factorise.
  double lift = 100;
};

/// CHOLMOD on the positive definite `stiffness`, of which the last `border` unknowns are the flanks': an order that
/// leaves them last, factors in it - without them last, the flexibility of the flanks would be a back-solve for each -
/// and back-solves.
[[nodiscard]] std::vector<Kernel> sparse_kernels(const Eigen::SparseMatrix<double>& stiffness, Eigen::Index border);
/// dgetrf of n unknowns. Its units are operations, 2/3 n^3.
[[nodiscard]] Kernel dense_lu_kernel(Eigen::Index unknowns);
/// dpotrf and dpotri of n unknowns. Its units are operations, n^3.
[[nodiscard]] Kernel dense_inverse_kernel(Eigen::Index unknowns);
/// One array read, another written.
[[nodiscard]] Kernel traffic_kernel();

}  // namespace dovetail::benchmarks
