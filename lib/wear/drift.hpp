#pragma once

#include <Eigen/Core>
#include <memory>

#include "response/resonance.hpp"

namespace dovetail::wear {

/// How the resonance moves when the joint wears.
struct Drift {
  response::Resonance unworn, worn;
  /// worn / unworn - 1 of the frequencies; NaN unless both converged. Only meaningful as a difference on one mesh.
  double drift = 0.0;
};

/// Resonance with gap g + W found by the same criterion as `unworn`, starting from it. `start` is the condition of
/// the unworn joint (slip origin); `depth` [Nc] m replaces its wear depth.
[[nodiscard]] Drift resonance_drift(const std::shared_ptr<const response::CondensedModel>& model,
                                    const response::Resonance& unworn, const response::ContactCondition& start,
                                    const Eigen::VectorXd& depth, const response::SteadyOptions& steady,
                                    const response::ResonanceOptions& options);

}  // namespace dovetail::wear
