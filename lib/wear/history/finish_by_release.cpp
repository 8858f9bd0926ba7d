#include "wear/history/finish_by_release.hpp"

#include <utility>

#include "wear/measures.hpp"
#include "wear/params.hpp"
#include "wear/release/passes.hpp"

namespace dovetail::wear {

Finish finish_by_release(const steady::Joint& joint, const steady::State& state, const Eigen::VectorXd& depth,
                         double cycles, double close, const Watcher& watcher) {
  constexpr FinishByReleaseParams kParams;
  const double largest = depth.maxCoeff();
  const double threshold = kParams.still_wears * largest / cycles;
  Finish result;
  if (!(state.wear_rate.maxCoeff() > threshold) || rests_in_slip(*joint.model)) return result;
  WearingJoint wearing(joint.worn(depth), state.omega, watcher);
  Passes passes(joint.model->nodes());
  passes.state = state;
  const Ending ending = release_slipping(wearing, threshold, kParams.passes, {}, passes);
  if (ending == Ending::settled) {
    result.depth = wearing.depth(passes.released, passes.state);
    const Eigen::VectorXd change = result.depth - depth;
    const Eigen::VectorXd left = kParams.tail * cycles * state.wear_rate;
    if (change.maxCoeff() <= close * largest && (change - left).maxCoeff() <= kParams.slack * largest) {
      result.steady = wearing.worn(result.depth, state.displacement);
      result.done = result.steady.status == Status::converged &&
                    result.steady.wear_rate.maxCoeff() <= std::max(threshold, state.wear_rate.maxCoeff());
    }
  }
  result.solves = wearing.solves();
  result.jacobians = wearing.jacobians();
  return result;
}

}  // namespace dovetail::wear
