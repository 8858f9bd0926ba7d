#include "response/frequency_response.hpp"

namespace dovetail::response {

std::vector<SteadyState> frequency_response(const std::shared_ptr<const CondensedModel>& model,
                                            std::span<const double> omega, const ContactCondition& condition,
                                            const SteadyOptions& options,
                                            const std::function<bool(std::size_t point, const SteadyState&)>& progress,
                                            bool keep_linearisations) {
  std::vector<SteadyState> states;
  SteadyOptions with_predictor = options;
  with_predictor.linearise = true;
  Eigen::MatrixXd slope;
  bool stopped = false;
  for (std::size_t point = 0; point < omega.size(); ++point) {
    if (stopped) {
      states.emplace_back();
      states.back().status = Status::interrupted;
      states.back().omega = omega[point];
      continue;
    }
    Eigen::MatrixXd guess;
    if (!states.empty() && states.back().status == Status::converged) {
      guess = states.back().displacement;
      if (slope.size() > 0) guess += (omega[point] - states.back().omega) * slope;
    }
    states.push_back(steady_state(model, omega[point], condition, with_predictor, guess));
    SteadyState& state = states.back();
    slope.resize(0, 0);
    if (state.linearisation) slope = state.linearisation->response_to_frequency();
    if (progress && !progress(point, state)) stopped = true;
    if (!keep_linearisations) state.linearisation.reset();
  }
  return states;
}

}  // namespace dovetail::response
