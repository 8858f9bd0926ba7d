#include "paths/frequency_response.hpp"

#include <array>
#include <cmath>

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
      constexpr std::array kFurther{0.01, 0.03, 0.1};
      for (std::size_t i = 0; state.status != Status::converged && i < kFurther.size(); ++i) {
        const double beyond = omega * (1 + std::copysign(kFurther[i], omega - before.omega));
        const steady::State other = steady_state(plain(), beyond);
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

  // One method and one eps: failing is cheap and says where the branch ends.
  [[nodiscard]] steady::Joint plain() const {
    steady::Joint plain = joint_;
    plain.options.penalty_cascade = false;
    if (plain.options.solver == "auto") plain.options.solver = "newton";
    return plain;
  }

  [[nodiscard]] steady::State from_last(double omega, const steady::Joint& joint) const {
    if (!last_.tangent) return steady_state(joint, omega);
    const Eigen::MatrixXd guess = last_.displacement + (omega - last_.omega) * last_.tangent->response_to_frequency();
    return steady_state(joint, omega, guess, last_.tangent);
  }

  // Halves the way to omega while that fails, and carries on from where it got.
  steady::State approached(double omega) {
    constexpr int kHalvings = 6;
    int iterations = 0, evaluations = 0, intermediate = 0, halvings = 0;
    double target = omega;
    while (true) {
      steady::State state = from_last(target, plain());
      iterations += state.iterations;
      evaluations += state.evaluations;
      state.iterations = iterations;
      state.evaluations = evaluations;
      state.intermediate = intermediate;
      if (state.status == Status::converged) last_ = state;
      if (target == omega && state.status == Status::converged) return state;
      if (state.status == Status::converged) {
        ++intermediate;
        target = omega;
      } else if (halvings++ < kHalvings) {
        target = (target + last_.omega) / 2;
      } else {
        return state;
      }
    }
  }

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
