#include "response/peak_shift.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>

#include "response/real_block.hpp"
#include "response/refined_state.hpp"

namespace dovetail::response {
namespace {

// Half of the frequency range over which the amplitude is large: for one mode 1/Y = (pole - omega)/R and at the peak
// |Y / (dY/dw)| = |pole - omega| is the imaginary part of the pole. Y is the output's largest harmonic.
double half_width(const Resonance& at, Eigen::Index output) {
  constexpr double kNarrowest = 1e-6, kDefault = 1e-3, kWidest = 0.05;
  if (!at.state.linearisation) return kDefault * at.omega;
  const SteadyResidual& residual = at.state.linearisation->residual();
  const Eigen::MatrixXd response = at.state.linearisation->response_to_frequency();
  Eigen::Index h = 1;
  for (Eigen::Index j = 2; 2 * j < at.state.outputs.cols(); ++j)
    if (std::abs(harmonic_of(at.state.outputs, j)(output)) > std::abs(harmonic_of(at.state.outputs, h)(output))) h = j;
  const HarmonicStiffness& stiffness = residual.system().harmonics[static_cast<std::size_t>(h)];
  const Eigen::VectorXcd contact = harmonic_of(at.state.displacement, h), change = harmonic_of(response, h);
  const Eigen::VectorXcd slope = residual.model().output_gradient(stiffness) * change +
                                 residual.model().output_slope(static_cast<int>(h), at.state.omega, stiffness, contact);
  const double width = std::abs(harmonic_of(at.state.outputs, h)(output)) / std::abs(slope(output));
  return std::isfinite(width) ? std::clamp(width, kNarrowest * at.omega, kWidest * at.omega) : kDefault * at.omega;
}

}  // namespace

PeakShift peak_shift(const std::shared_ptr<const CondensedModel>& model, const Resonance& at, Eigen::Index output,
                     const ContactCondition& condition, const SteadyOptions& other) {
  // The state in the middle lends its factors to those beside it.
  SteadyOptions options = other, beside_options = other;
  options.linearise = true;
  beside_options.linearise = false;
  PeakShift shift;
  const auto converged = [&shift](const SteadyState& state) {
    shift.jacobians += state.iterations;
    shift.status = state.status;
    return shift.status == Status::converged;
  };
  shift.state = refined_state(model, at.state, condition, options);
  if (!converged(shift.state)) return shift;
  const double width = half_width(at, output), step = 0.1 * width;
  SteadyState centre = shift.state;
  for (int move = 0; move < 4; ++move) {
    std::array<double, 2> beside{};
    for (const std::size_t side : {0u, 1u}) {
      SteadyState start = centre;
      start.omega += side == 0 ? -step : step;
      const SteadyState state = refined_state(model, start, condition, beside_options, centre.linearisation);
      if (!converged(state)) return shift;
      beside[side] = state.amplitudes(output);
    }
    const double here = centre.amplitudes(output);
    const double slope = (beside[1] - beside[0]) / (2 * step);
    const double curvature = (beside[1] - 2 * here + beside[0]) / (step * step);
    // Where the curve bends upwards the maximum is further up the slope.
    const double to_vertex = curvature < 0 ? -slope / curvature : std::copysign(width, slope);
    if (curvature < 0 && std::abs(to_vertex) <= 2 * step) {
      shift.omega = std::abs(centre.omega + to_vertex - at.omega);
      shift.amplitude = std::abs(here - slope * slope / (2 * curvature) - at.amplitude);
      return shift;
    }
    SteadyState start = centre;
    start.omega += std::clamp(to_vertex, -width, width);
    centre = refined_state(model, start, condition, options, centre.linearisation);
    if (!converged(centre)) return shift;
  }
  shift.status = Status::no_bracket;
  return shift;
}

}  // namespace dovetail::response
