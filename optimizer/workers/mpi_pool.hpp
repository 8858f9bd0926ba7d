#pragma once

#include <vector>

#include "optimizer/workers/worker_pool.hpp"

namespace dovetail::optimizer {

/// The other ranks of an MPI job, which serve. A rank that is lost ends the job, unless MPI goes on without it: its
/// task is then told without an answer when nobody has heard of it for too long.
class MpiPool : public WorkerPool {
 public:
  /// @param patience_s  > 0; a task that takes longer is given up, and its rank asked no more
  explicit MpiPool(double patience_s);

  [[nodiscard]] std::size_t size() const override;
  void prepare(const std::string& common) override;
  void run(std::span<const std::string> tasks, const std::function<bool(Finished)>& told) override;

 private:
  double patience_;
  std::vector<bool> lost_;  // by rank
};

/// The life of the other ranks: they answer until dismiss() ends it.
void serve(const WorkerFactory& factory);
/// Of the first rank.
void dismiss();

}  // namespace dovetail::optimizer
