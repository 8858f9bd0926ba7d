#pragma once

#include <Eigen/SparseCore>
#include <memory>
#include <mutex>
#include <vector>

#include "numerics/params.hpp"

namespace dovetail::numerics {

struct SymbolicFactor;

/// Keeps the order of elimination that was found last, and what it makes of the pattern, for matrices with the same
/// pattern: by constrained minimum degree [CAMD], and by nested dissection [METIS] where that promises less work. May
/// be used from several threads.
class EliminationOrder {
 public:
  explicit EliminationOrder(const OrderParams& params = {}) : params_(params) {}

  /// Of a compressed matrix, of which only the upper triangle is there, with its last `border` rows last and as they
  /// are: the order kept if it is of this pattern, else a new one, which is kept.
  [[nodiscard]] std::shared_ptr<const SymbolicFactor> of(const Eigen::SparseMatrix<double>& upper, Eigen::Index border);

 private:
  OrderParams params_;
  std::mutex mutex_;
  std::vector<int> outer_, inner_;  // of the pattern
  Eigen::Index border_ = 0;
  std::shared_ptr<const SymbolicFactor> analysis_;
};

}  // namespace dovetail::numerics
