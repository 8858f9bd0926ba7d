#pragma once

#include <Eigen/Core>

#include "reduction/reduced_model.hpp"
#include "response/resonance.hpp"

namespace dovetail::wear {

/// How the resonance moves when the joint wears.
struct Drift {
  response::Resonance unworn, worn;
  /// worn / unworn - 1 of the frequencies; NaN unless both converged. Only meaningful as a difference on one mesh.
  double drift = 0.0;
};

/// Resonance with gap g + W, found by the same criterion as `unworn` and starting from it.
[[nodiscard]] Drift resonance_drift(const reduction::ReducedModel& model, const response::Resonance& unworn,
                                    const Eigen::VectorXd& depth, const response::SteadyOptions& steady,
                                    const response::ResonanceOptions& options, int output = 0);

}  // namespace dovetail::wear
