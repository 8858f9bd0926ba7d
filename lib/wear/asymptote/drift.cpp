#include "wear/asymptote/drift.hpp"

#include <limits>

namespace dovetail::wear {

Drift resonance_drift(const steady::Joint& worn, const paths::Resonance& unworn, const paths::ResonanceOptions& options,
                      const steady::State* known) {
  // The peak is followed: one found elsewhere would be no drift.
  paths::ResonanceOptions follow = options;
  follow.sweep_range = 0;
  Drift result;
  result.unworn = unworn;
  const steady::State& start = known != nullptr ? *known : unworn.state;
  result.worn = paths::resonance(worn, start.omega, follow, start.displacement);
  const bool both = unworn.status == Status::converged && result.worn.status == Status::converged;
  result.drift = both ? result.worn.omega / unworn.omega - 1.0 : std::numeric_limits<double>::quiet_NaN();
  return result;
}

}  // namespace dovetail::wear
