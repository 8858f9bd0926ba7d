#include "response/peak_shift.hpp"

#include <cmath>

#include "response/refined_state.hpp"

namespace dovetail::response {

PeakShift peak_shift(const std::shared_ptr<const CondensedModel>& model, const Resonance& at, Eigen::Index output,
                     const ContactCondition& condition, const SteadyOptions& other) {
  SteadyOptions options = other;
  options.linearise = true;
  PeakShift shift;
  shift.state = refined_state(model, at.state, condition, options);
  shift.jacobians = shift.state.iterations;
  shift.status = shift.state.status;
  if (shift.status != Status::converged) return shift;
  // A hundredth of the peak's width even at a damping ratio of 1e-3: dA/dw is close to linear over it.
  const double step = 1e-5 * at.omega;
  options.penalty_scale *= at.state.penalty_ratio;
  options.penalty_cascade = false;
  const SteadyState beside = steady_state(model, at.omega + step, condition, options, shift.state.displacement);
  shift.jacobians += beside.iterations;
  shift.status = beside.status;
  if (shift.status != Status::converged) return shift;
  const AmplitudeSlope a = amplitude_slope(shift.state, output), b = amplitude_slope(beside, output);
  const double curvature = (b.slope - a.slope) / step;
  shift.amplitude = std::abs(a.amplitude - at.amplitude);
  if (curvature < 0) {
    shift.omega = std::abs(a.slope / curvature);
    shift.amplitude += a.slope * a.slope / (2 * std::abs(curvature));
  } else {
    shift.status = Status::no_bracket;
  }
  return shift;
}

}  // namespace dovetail::response
