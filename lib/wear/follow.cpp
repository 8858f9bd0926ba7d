#include "wear/follow.hpp"

#include <cmath>

namespace dovetail::wear {

namespace {

/// Successive asymptotes at most, and the change of frequency that ends them.
constexpr int kPasses = 30;
constexpr double kTolerance = 1e-7;

}  // namespace

FollowedAsymptote followed_asymptote(const std::shared_ptr<const response::CondensedModel>& model, double omega,
                                     const response::ContactCondition& start, const response::SteadyOptions& steady,
                                     const AsymptoteOptions& options, const response::ResonanceOptions& resonance,
                                     const response::SteadyState* unworn, const Control& control) {
  FollowedAsymptote result;
  result.held = asymptote(model, omega, start, steady, options, unworn, control);
  result.asymptote = result.held;
  result.omegas = {omega};
  result.solves = result.held.solves;
  result.jacobians = result.held.jacobians;
  // The peak is followed: one found elsewhere would be another.
  response::ResonanceOptions near = resonance;
  near.sweep_range = 0;
  Asymptote& last = result.asymptote;
  // Later passes begin worn: what is left of the wear is held against the unworn rate.
  AsymptoteOptions onwards = options;
  if (result.held.unworn_rate.size() > 0 && !(onwards.reference_rate > 0.0))
    onwards.reference_rate = result.held.unworn_rate.maxCoeff();
  const auto fail = [&](Status status) {
    last.verdict = Verdict::not_converged;
    last.status = status;
    return result;
  };
  for (int pass = 0; last.verdict == Verdict::asymptote; ++pass) {
    if (pass == kPasses) return fail(Status::iteration_limit);
    if (control.stopped()) return fail(Status::interrupted);
    response::ContactCondition condition = start;
    // Whole nodes: edges that bear in part would wear anew at every frequency.
    condition.wear_depth = last.depth;
    const response::Resonance worn =
        response::resonance(model, omega, condition, steady, near, last.steady.displacement);
    result.solves += worn.solves;
    result.jacobians += worn.jacobians;
    if (worn.status != Status::converged) return fail(worn.status);
    const bool stays = std::abs(worn.omega / omega - 1) < kTolerance;
    omega = worn.omega;
    if (stays) return result;
    last = asymptote(model, omega, condition, steady, onwards, nullptr, control);
    result.omegas.push_back(omega);
    result.solves += last.solves;
    result.jacobians += last.jacobians;
  }
  return result;
}

}  // namespace dovetail::wear
