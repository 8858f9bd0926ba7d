#include "paths/frequency_response.hpp"

#include <cmath>

#include "paths/params.hpp"
#include "paths/reach.hpp"

namespace dovetail::paths {
namespace {

// Goes from frequency to frequency, each state started from the last one that converged.
class Sweep {
 public:
  explicit Sweep(const steady::Joint& joint) : joint_(joint) { joint_.options.linearise = true; }

  steady::State at(double omega) {
    const steady::State before = last_;
    steady::State state;
    state.status = Status::no_bracket;
    // Smaller steps stay on the branch and keep its eps, another eps of the cascade need not.
    if (last_.tangent && last_.penalty_ratio == 1) {
      state = approached(omega);
      // Behind a turning point the branch ends, and Newton dwells where it did: another one is met further on, and
      // followed back to omega.
      for (const double further : kParams.further) {
        if (state.status == Status::converged) break;
        const double beyond = omega * (1 + std::copysign(further, omega - before.omega));
        const steady::State other = steady_state(joint_.with(joint_.options.plain()), beyond);
        steady::State back;
        if (other.status == Status::converged) {
          last_ = other;
          back = approached(omega);
          ++back.intermediate;
        } else {
          back.status = other.status;
        }
        state = added(added(std::move(back), other), state);
      }
      if (state.status != Status::converged) last_ = before;
    }
    if (state.status != Status::converged) state = added(from_last(omega, joint_), state);
    if (state.status == Status::converged) last_ = state;
    return state;
  }

 private:
  // `state` with the work that went before it.
  [[nodiscard]] static steady::State added(steady::State state, const steady::State& before) {
    state.iterations += before.iterations;
    state.evaluations += before.evaluations;
    state.intermediate += before.intermediate;
    return state;
  }

  [[nodiscard]] steady::State from_last(double omega, const steady::Joint& joint) const {
    if (!last_.tangent) return steady_state(joint, omega);
    const Eigen::MatrixXd guess = last_.displacement + (omega - last_.omega) * last_.tangent->response_to_frequency();
    return steady_state(joint, omega, guess, last_.tangent);
  }

  // Halves the way to omega while that fails, and carries on from where it got.
  steady::State approached(double omega) {
    steady::State state;
    const steady::Joint plain = joint_.with(joint_.options.plain());
    const Reach reached = reach(last_.omega, omega, kParams.halvings, [&](double target) {
      state = added(from_last(target, plain), state);
      if (state.status == Status::converged) last_ = state;
      return state.status == Status::converged;
    });
    state.intermediate = reached.intermediate;
    return state;
  }

  static constexpr SweepParams kParams = {};
  steady::Joint joint_;
  steady::State last_;  // the last converged one, with its tangent
};

}  // namespace

std::vector<steady::State> frequency_response(
    const steady::Joint& joint, std::span<const double> omega,
    const std::function<bool(std::size_t point, const steady::State&)>& progress, bool keep_tangents) {
  std::vector<steady::State> states;
  Sweep sweep(joint);
  bool stopped = false;
  for (std::size_t point = 0; point < omega.size(); ++point) {
    if (stopped) {
      states.emplace_back();
      states.back().status = Status::interrupted;
      states.back().omega = omega[point];
      continue;
    }
    states.push_back(sweep.at(omega[point]));
    steady::State& state = states.back();
    if (progress && !progress(point, state)) stopped = true;
    if (!keep_tangents) state.tangent.reset();
  }
  return states;
}

}  // namespace dovetail::paths
