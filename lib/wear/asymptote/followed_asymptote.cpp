#include "wear/asymptote/followed_asymptote.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "wear/measures.hpp"
#include "wear/params.hpp"

namespace dovetail::wear {

namespace {

/// What an earlier pass left in doubt, the way to the last one leaves in doubt, too. Other states are as far from the
/// last one as they were from the earlier one.
void keep_doubt(const Asymptote& earlier, const reduction::ContactNodes& contact, Asymptote& last) {
  last.bearing.needed = last.bearing.needed || earlier.bearing.needed;
  last.bearing.share = std::min(last.bearing.share, earlier.bearing.share);
  last.bearing.closing = std::max(last.bearing.closing, earlier.bearing.closing);
  if (earlier.doubt == Doubt::none) return;
  const bool alone = last.doubt == Doubt::none;
  if (alone) last.doubt = earlier.doubt;
  if (alone || earlier.decided_by == FoundBy::history) last.decided_by = earlier.decided_by;
  last.confirmed_by_history = earlier.confirmed_by_history && (alone || last.confirmed_by_history);
  if (last.history == Status::converged) last.history = earlier.history;
  for (const OtherState& other : earlier.other_states)
    last.other_states.push_back(other_state(other.found_by, contact, other.depth + last.depth - earlier.depth));
}

/// Nodes worn off earlier stay so, and zones end where the last pass of all left them.
void keep_released(const Asymptote& earlier, Asymptote& last) {
  const int passes = static_cast<int>(earlier.trail.reserves.size());
  ReleaseTrail all = earlier.trail;
  all.reserves.insert(all.reserves.end(), last.trail.reserves.begin(), last.trail.reserves.end());
  for (std::size_t i = 0; i < earlier.released.size(); ++i) {
    if (all.released_in[i] < 0 && last.trail.released_in[i] >= 0)
      all.released_in[i] = passes + last.trail.released_in[i];
    last.released[i] = last.released[i] || earlier.released[i];
  }
  last.trail = std::move(all);
  last.passes += earlier.passes;
}

}  // namespace

FollowedAsymptote followed_asymptote(const steady::Joint& joint, double omega, const AsymptoteOptions& options,
                                     const paths::ResonanceOptions& resonance, const steady::State* unworn,
                                     const Watcher& watcher) {
  FollowedAsymptote result;
  Asymptote& last = result.asymptote;
  last = asymptote(joint, omega, options, unworn, watcher);
  result.held = last;
  result.omegas = {omega};
  result.solves = last.solves;
  result.jacobians = last.jacobians;
  // The peak is followed: one found elsewhere would be another.
  paths::ResonanceOptions near = resonance;
  near.sweep_range = 0;
  // Later passes begin worn: what is left of the wear is held against the unworn rate.
  AsymptoteOptions onwards = options;
  if (!(onwards.reference_rate > 0.0)) onwards.reference_rate = largest(last.unworn_rate);
  const auto fail = [&](Status status) {
    last.verdict = Verdict::not_converged;
    last.status = status;
    return result;
  };
  for (int pass = 0; last.verdict == Verdict::asymptote; ++pass) {
    if (pass == FollowParams{}.asymptotes) return fail(Status::iteration_limit);
    if (watcher.stopped()) return fail(Status::interrupted);
    const steady::Joint worn_joint = joint.worn(last.depth);
    const paths::Resonance worn = paths::resonance(worn_joint, omega, near, last.steady.displacement);
    result.solves += worn.solves;
    result.jacobians += worn.jacobians;
    if (worn.status != Status::converged) return fail(worn.status);
    const bool stays = std::abs(worn.omega / omega - 1) < FollowParams{}.tolerance;
    omega = worn.omega;
    if (stays) return result;
    const Asymptote earlier = std::move(last);
    last = asymptote(worn_joint, omega, onwards, nullptr, watcher);
    keep_released(earlier, last);
    if (last.verdict == Verdict::asymptote) keep_doubt(earlier, joint.model->contact(), last);
    result.omegas.push_back(omega);
    result.solves += last.solves;
    result.jacobians += last.jacobians;
  }
  return result;
}

}  // namespace dovetail::wear
