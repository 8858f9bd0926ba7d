#include "wear/finish.hpp"

#include <utility>

#include "wear/passes.hpp"

namespace dovetail::wear {

Finish finish_by_release(const std::shared_ptr<const response::CondensedModel>& model, double omega,
                         const response::ContactCondition& start, const response::SteadyOptions& steady,
                         const response::SteadyState& state, const Eigen::VectorXd& depth, double cycles, double close,
                         const Control& control) {
  constexpr double kStillWears = 1e-5;
  constexpr int kPasses = 10;
  response::ContactCondition worn = start;
  worn.wear_depth = depth;
  const double largest = depth.maxCoeff();
  const double threshold = kStillWears * largest / cycles;
  Finish result;
  if (!(state.wear_rate.maxCoeff() > threshold)) return result;
  Release release(model, omega, worn, steady, control);
  Passes passes(model->nodes());
  passes.state = state;
  const Ending ending = release_slipping(release, threshold, kPasses, {}, passes);
  if (ending == Ending::settled) {
    result.depth = release.depth(passes.released, passes.state);
    if ((result.depth - depth).maxCoeff() <= close * largest) {
      result.steady = release.solve_worn(result.depth, state.displacement);
      result.done = result.steady.status == Status::converged &&
                    result.steady.wear_rate.maxCoeff() <= std::max(threshold, state.wear_rate.maxCoeff());
    }
  }
  result.solves = release.solves();
  result.jacobians = release.jacobians();
  return result;
}

}  // namespace dovetail::wear
