#pragma once

#include <Eigen/Core>
#include <memory>

#include "response/steady_state.hpp"

namespace dovetail::wear {

/// How nearly nothing wears any more at given depths, with contact everywhere.
struct Certificate {
  Status status = Status::converged;
  double remaining = 0.0;  ///< largest rate over the largest unworn one; NaN when the state could not be solved
  int harmonics = 0, samples = 0;
  int jacobians = 0;
};

/// 2H+1 harmonics and 2N samples, more where the harmonics need them.
[[nodiscard]] response::SteadyOptions finer_settings(const response::SteadyOptions& steady);

/// Solves with gap g + W at `settings`, which may differ from those of `from`: what rests at H harmonics and N samples
/// may slip at more.
///
/// @param start    slip origin; `depth` [Nc] m replaces its wear depth
/// @param fastest  largest unworn rate, m per cycle
/// @param from     steady state near the one with `depth`, at the frequency wanted
/// Cost: one steady state, warm-started.
[[nodiscard]] Certificate certificate(const std::shared_ptr<const response::CondensedModel>& model,
                                      const response::ContactCondition& start, const Eigen::VectorXd& depth,
                                      double fastest, const response::SteadyState& from,
                                      response::SteadyOptions settings);

}  // namespace dovetail::wear
