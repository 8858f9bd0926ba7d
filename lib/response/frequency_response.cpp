#include "response/frequency_response.hpp"

#include <array>
#include <cmath>

namespace dovetail::response {
namespace {

// Goes from frequency to frequency, each state started from the last one that converged.
class Sweep {
 public:
  Sweep(const std::shared_ptr<const CondensedModel>& model, const ContactCondition& condition,
        const SteadyOptions& options)
      : model_(model), condition_(condition), options_(options) {
    options_.linearise = true;
  }

  SteadyState at(double omega) {
    const SteadyState before = last_;
    SteadyState state;
    state.status = Status::no_bracket;
    // Smaller steps stay on the branch and keep its eps, another eps of the cascade need not.
    if (last_.linearisation && last_.penalty_ratio == 1) {
      state = approached(omega);
      // Behind a turning point the branch ends, and Newton dwells where it did: another one is met further on, and
      // followed back to omega.
      constexpr std::array kFurther{0.01, 0.03, 0.1};
      for (std::size_t i = 0; state.status != Status::converged && i < kFurther.size(); ++i) {
        const double beyond = omega * (1 + std::copysign(kFurther[i], omega - before.omega));
        const SteadyState other = steady_state(model_, beyond, condition_, plain());
        SteadyState back;
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
    if (state.status != Status::converged) state = added(from_last(omega, options_), state);
    if (state.status == Status::converged) last_ = state;
    return state;
  }

 private:
  // `state` with the work that went before it.
  [[nodiscard]] static SteadyState added(SteadyState state, const SteadyState& before) {
    state.iterations += before.iterations;
    state.evaluations += before.evaluations;
    state.intermediate += before.intermediate;
    return state;
  }

  // One method and one eps: failing is cheap and says where the branch ends.
  [[nodiscard]] SteadyOptions plain() const {
    SteadyOptions plain = options_;
    plain.penalty_cascade = false;
    if (plain.solver == "auto") plain.solver = "newton";
    return plain;
  }

  [[nodiscard]] SteadyState from_last(double omega, const SteadyOptions& options) const {
    if (!last_.linearisation) return steady_state(model_, omega, condition_, options);
    const Eigen::MatrixXd guess =
        last_.displacement + (omega - last_.omega) * last_.linearisation->response_to_frequency();
    return steady_state(model_, omega, condition_, options, guess, last_.linearisation);
  }

  // Halves the way to omega while that fails, and carries on from where it got.
  SteadyState approached(double omega) {
    constexpr int kHalvings = 6;
    int iterations = 0, evaluations = 0, intermediate = 0, halvings = 0;
    double target = omega;
    while (true) {
      SteadyState state = from_last(target, plain());
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

  const std::shared_ptr<const CondensedModel>& model_;
  const ContactCondition& condition_;
  SteadyOptions options_;
  SteadyState last_;  // the last converged one, with linearisation
};

}  // namespace

std::vector<SteadyState> frequency_response(const std::shared_ptr<const CondensedModel>& model,
                                            std::span<const double> omega, const ContactCondition& condition,
                                            const SteadyOptions& options,
                                            const std::function<bool(std::size_t point, const SteadyState&)>& progress,
                                            bool keep_linearisations) {
  std::vector<SteadyState> states;
  Sweep sweep(model, condition, options);
  bool stopped = false;
  for (std::size_t point = 0; point < omega.size(); ++point) {
    if (stopped) {
      states.emplace_back();
      states.back().status = Status::interrupted;
      states.back().omega = omega[point];
      continue;
    }
    states.push_back(sweep.at(omega[point]));
    SteadyState& state = states.back();
    if (progress && !progress(point, state)) stopped = true;
    if (!keep_linearisations) state.linearisation.reset();
  }
  return states;
}

}  // namespace dovetail::response
