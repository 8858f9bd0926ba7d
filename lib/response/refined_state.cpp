#include "response/refined_state.hpp"

#include <algorithm>

namespace dovetail::response {

Eigen::MatrixXd padded(const Eigen::MatrixXd& coefficients, int harmonics) {
  const Eigen::Index columns = 2 * harmonics + 1, kept = std::min(columns, coefficients.cols());
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(coefficients.rows(), columns);
  result.leftCols(kept) = coefficients.leftCols(kept);
  return result;
}

SteadyState refined_state(const std::shared_ptr<const CondensedModel>& model, const SteadyState& state,
                          const ContactCondition& condition, SteadyOptions finer,
                          const std::shared_ptr<const Linearisation>& reuse) {
  finer.penalty_scale *= state.penalty_ratio;
  finer.penalty_cascade = false;
  finer.max_rescue_iterations = 0;
  finer.show_regular = false;
  SteadyState refined =
      steady_state(model, state.omega, condition, finer, padded(state.displacement, finer.harmonics), reuse);
  refined.penalty_ratio *= state.penalty_ratio;
  return refined;
}

}  // namespace dovetail::response
