#include "wear/finish.hpp"

#include <utility>

#include "wear/measures.hpp"
#include "wear/passes.hpp"

namespace dovetail::wear {

Finish finish_by_release(const steady::Joint& joint, const steady::State& state, const Eigen::VectorXd& depth,
                         double cycles, double close, const Control& control) {
  constexpr double kStillWears = 1e-5;
  constexpr int kPasses = 10;
  // Rates that die out like n^-p, p > 4/3, leave less than this many times rate times cycles.
  constexpr double kTail = 3.0;
  constexpr double kSlack = 1e-3;  // depth that neighbours wear after them, relative to the largest
  const double largest = depth.maxCoeff();
  const double threshold = kStillWears * largest / cycles;
  Finish result;
  if (!(state.wear_rate.maxCoeff() > threshold) || rests_in_slip(*joint.model)) return result;
  WearingJoint wearing(joint.worn(depth), state.omega, control);
  Passes passes(joint.model->nodes());
  passes.state = state;
  const Ending ending = release_slipping(wearing, threshold, kPasses, {}, passes);
  if (ending == Ending::settled) {
    result.depth = wearing.depth(passes.released, passes.state);
    const Eigen::VectorXd change = result.depth - depth;
    const Eigen::VectorXd left = kTail * cycles * state.wear_rate;
    if (change.maxCoeff() <= close * largest && (change - left).maxCoeff() <= kSlack * largest) {
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
