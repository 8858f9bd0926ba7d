#pragma once

#include "paths/resonance.hpp"

namespace dovetail::wear {

/// How the resonance moves when the joint wears.
struct Drift {
  paths::Resonance unworn, worn;
  /// worn / unworn - 1 of the frequencies; NaN unless both converged. Only meaningful as a difference on one mesh.
  double drift = 0.0;
};

/// Resonance of the worn joint found by the same criterion as `unworn`, starting from it, or from `known`, a state of
/// the worn joint near by.
[[nodiscard]] Drift resonance_drift(const steady::Joint& worn, const paths::Resonance& unworn,
                                    const paths::ResonanceOptions& options, const steady::State* known = nullptr);

}  // namespace dovetail::wear
