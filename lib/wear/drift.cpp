#include "wear/drift.hpp"

#include <limits>

namespace dovetail::wear {

Drift resonance_drift(const std::shared_ptr<const response::CondensedModel>& model, const response::Resonance& unworn,
                      const response::ContactCondition& start, const Eigen::VectorXd& depth,
                      const response::SteadyOptions& steady, const response::ResonanceOptions& options) {
  response::ContactCondition condition = start;
  condition.wear_depth = depth;
  // The peak is followed: one found elsewhere would be no drift.
  response::ResonanceOptions follow = options;
  follow.sweep_range = 0;
  Drift result;
  result.unworn = unworn;
  result.worn = response::resonance(model, unworn.omega, condition, steady, follow, unworn.state.displacement);
  const bool both = unworn.status == Status::converged && result.worn.status == Status::converged;
  result.drift = both ? result.worn.omega / unworn.omega - 1.0 : std::numeric_limits<double>::quiet_NaN();
  return result;
}

}  // namespace dovetail::wear
