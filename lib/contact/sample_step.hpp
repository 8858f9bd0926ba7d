#pragma once

#include <cmath>

#include "contact/march.hpp"

namespace dovetail::contact {

/// What one sample did.
struct Step {
  SampleState state = SampleState::separated;
  double force[3] = {0, 0, 0};  ///< lambda
  bool rotated = false;         ///< the second-order return was used
  double trial[2] = {0, 0};     ///< pre_T
  FrictionLimit limit = {};     ///< at lambda_N
  double origin[2] = {0, 0};    ///< lambda_x,T where the loaded part of the interval before this sample begins, N
  double end[2] = {0, 0};       ///< lambda_x,T where it ends
  bool touched = false;         ///< it begins, or
  bool opened = false;          ///< ends, inside the interval:
  double crossing = 0;          ///< at this fraction of it
};

/// Turns the direction of slip of `memory` to that of a sample whose trial force leaves the limit: by the second-order
/// return where slip goes on, which it says in `step`, else straight along the trial.
inline void turn_slip(double square, SlipReturn rule, Memory& memory, Step& step) {
  double* const direction = memory.direction;
  const double along = direction[0] * step.trial[0] + direction[1] * step.trial[1];
  // A slip that reverses has no rotation to follow; the first-order return takes it.
  if (rule == SlipReturn::second_order && memory.slipped && along > 0) {
    step.rotated = true;
    // tan(phi / 2) = across / sum
    const double across = direction[0] * step.trial[1] - direction[1] * step.trial[0];
    const double sum = step.limit.force + along;
    const double scale = 1 / (sum * sum + across * across);
    const double cosine = scale * (sum * sum - across * across), sine = 2 * scale * sum * across;
    const double first = cosine * direction[0] - sine * direction[1];
    direction[1] = sine * direction[0] + cosine * direction[1];
    direction[0] = first;
  } else if (square > 0) {
    const double inverse = 1 / std::sqrt(square);
    direction[0] = step.trial[0] * inverse;
    direction[1] = step.trial[1] * inverse;
  }
}

/// One sample of the contact law for `Directions` tangential directions; updates `memory`. `previous` is the prediction
/// of the sample before. A node that touches down sticks from there on. The second-order rule begins and ends contact
/// where lambda_u,N, linear between the samples, passes zero, with lambda_x,T = lambda_u,T there; the first-order rule
/// does so at the sample without force.
template <int Directions>
inline Step sample_step(const double* previous, const double* prediction, const NodeLaw& law, SlipReturn rule,
                        Memory& memory) {
  Step step;
  const double normal = prediction[0];
  const bool loaded = normal > 0;
  if (rule == SlipReturn::second_order && loaded == memory.separated && loaded != (previous[0] > 0)) {
    (loaded ? step.touched : step.opened) = true;
    step.crossing = previous[0] / (previous[0] - normal);
  }
  const auto at_crossing = [&](int r) {
    return (1 - step.crossing) * previous[1 + r] + step.crossing * prediction[1 + r];
  };
  if (!loaded) {
    for (int r = 0; r < Directions; ++r) {
      step.origin[r] = memory.separated ? prediction[1 + r] : memory.slip_force[r];
      step.end[r] = step.opened ? at_crossing(r) : prediction[1 + r];
      memory.slip_force[r] = prediction[1 + r];
    }
    memory.slipped = false;
    memory.separated = true;
    return step;
  }
  memory.separated = false;
  for (int r = 0; r < Directions; ++r) {
    if (step.touched) memory.slip_force[r] = at_crossing(r);
    step.origin[r] = step.end[r] = memory.slip_force[r];
  }
  step.force[0] = normal;
  step.limit = law.limit(normal);
  const double limit = step.limit.force;
  double square = 0;
  for (int r = 0; r < Directions; ++r) {
    step.trial[r] = prediction[1 + r] - memory.slip_force[r];
    square += step.trial[r] * step.trial[r];
  }
  if (limit > 0 && square <= limit * limit) {
    for (int r = 0; r < Directions; ++r) step.force[1 + r] = step.trial[r];
    step.state = SampleState::stuck;
    memory.slipped = false;
    return step;
  }
  step.state = SampleState::slipping;
  if constexpr (Directions == 1) {
    step.force[1] = std::copysign(limit, step.trial[0]);
  } else {
    turn_slip(square, rule, memory, step);
    step.force[1] = limit * memory.direction[0];
    step.force[2] = limit * memory.direction[1];
  }
  for (int r = 0; r < Directions; ++r) step.end[r] = memory.slip_force[r] = prediction[1 + r] - step.force[1 + r];
  memory.slipped = true;
  return step;
}

}  // namespace dovetail::contact
