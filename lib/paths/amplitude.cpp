#include "paths/amplitude.hpp"

#include <algorithm>

#include "dynamics/extremes.hpp"
#include "dynamics/real_block.hpp"
#include "paths/params.hpp"
#include "steady/problem.hpp"

namespace dovetail::paths {

AmplitudeAt amplitude_at(const steady::Point& point, const branches::Vector& direction, Eigen::Index output) {
  const steady::Problem& problem = *point.problem;
  const dynamics::CondensedModel& model = problem.model();
  const Eigen::Index k = point.displacement.cols();
  Eigen::MatrixXd value(1, k), change(1, k);
  for (std::size_t h = 0; h < problem.system().harmonics.size(); ++h) {
    const dynamics::CondensedHarmonic& at = problem.system().harmonics[h];
    const auto j = static_cast<Eigen::Index>(h);
    const Eigen::VectorXcd contact = dynamics::harmonic_of(point.displacement, j);
    const Eigen::VectorXcd moved =
        model.output_gradient(at) * dynamics::harmonic_of(direction.displacement, j) +
        direction.parameter * model.output_slope(static_cast<int>(h), problem.system().omega, at, contact);
    dynamics::put_harmonic(model.outputs(at, contact).segment(output, 1), j, value);
    dynamics::put_harmonic(moved.segment(output, 1), j, change);
  }
  const dynamics::Extremes ends = dynamics::extremes(value.row(0).transpose());
  // The extremes are stationary in time: only the coefficients move them, to first order.
  const Eigen::VectorXd difference =
      dynamics::fourier_row(ends.tau_maximum, k) - dynamics::fourier_row(ends.tau_minimum, k);
  const double size = branches::vibration(value);
  return {.value = ends.amplitude(),
          .change = change.row(0).dot(difference) / 2,
          .speed = size > 0 ? branches::vibration(change) / size : 0};
}

AmplitudeSlope amplitude_slope(const steady::State& state, Eigen::Index output) {
  const branches::Vector along{.displacement = state.tangent->response_to_frequency(), .parameter = 1};
  const AmplitudeAt at = amplitude_at(state.tangent->point(), along, output);
  constexpr WidthParams kParams;
  const double width = at.speed > 0 ? 1 / (at.speed * state.omega) : kParams.widest;
  return {.amplitude = at.value,
          .slope = at.change,
          .width = state.omega * std::clamp(width, kParams.sharpest, kParams.widest)};
}

}  // namespace dovetail::paths
