#pragma once

#include <memory>
#include <string>
#include <vector>

#include "optimizer/search/run.hpp"
#include "optimizer/workers/worker_pool.hpp"
#include "studies/program/engine/run_engine.hpp"

namespace dovetail::studies {

/// What a worker needs to know of a run before it is asked for pieces of it, as text.
/// - `finer`: the study whose settings designs are verified at; null: the engine chooses them
[[nodiscard]] std::string description_of(const Study& study, const Study* finer = nullptr);

/// Workers that make the engine of such a description. A piece is asked for, and answered, as text.
[[nodiscard]] optimizer::WorkerFactory workers_with(const RunEngineFactory& make_engine);

/// The engine of the study whose pieces the pool, prepared for it, works on: candidates of a batch and cases of a
/// candidate at once, and with the same results. A worker that ends or hangs is a candidate that failed. Study and pool
/// must outlive it.
[[nodiscard]] RunEngine at_work(const Study& study, const RunEngine& engine, optimizer::WorkerPool& pool);

/// Verifications, each of a design in a case; `told` as for WorkerPool::run.
struct Verified {
  std::vector<double> x;
  std::size_t load = 0;
};
void verify_at_once(std::span<const Verified> wanted, optimizer::WorkerPool& pool,
                    const std::function<bool(std::size_t, report::VerificationRecord)>& told);

}  // namespace dovetail::studies
