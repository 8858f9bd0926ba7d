#include <algorithm>
#include <cmath>
#include <utility>

#include "wear/history/integrator.hpp"
#include "wear/measures.hpp"

namespace dovetail::wear {

namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

class ExplicitJumps : public Integrator {
 public:
  ExplicitJumps(WearingJoint& joint, const HistoryOptions& options, steady::State first, const ExplicitParams& params)
      : joint_(joint), options_(options), params_(params), state_(std::move(first)) {}

  [[nodiscard]] Status advance(double limit, Course& course) override {
    const VectorXd rate = course.point.rate;
    const double remaining = limit - course.cycles;
    double jump = std::min(cycle_jump(rate, options_.increment), remaining);
    if (controlled() && course.memory.step > 0.0) jump = std::min(jump, course.memory.step);
    for (int halving = 0;;) {
      const VectorXd change = jump * rate;
      MatrixXd guess = state_.displacement;
      if (state_.tangent) guess += state_.tangent->response_to_wear(change);
      const VectorXd depth = course.point.depth + change;
      steady::State next = joint_.worn(depth, guess);
      if (cut_short(next.status)) return next.status;
      if (next.status != Status::converged) {
        ++course.rejected;
        if (halving++ == params_.halvings) return next.status;
        jump *= 0.5;
        continue;
      }
      if (controlled()) {
        const double error = 0.5 * jump * (next.wear_rate - rate).cwiseAbs().maxCoeff() / course.error_scale(depth);
        const double factor = params_.safety * std::sqrt(options_.tolerance / std::max(error, 1e-300));
        if (error > options_.tolerance && change.maxCoeff() > params_.unresolved * options_.increment) {
          ++course.rejected;
          jump *= std::clamp(factor, params_.shortest_cut, params_.longest_cut);
          continue;
        }
        // A jump cut to end at the cycles asked for says nothing against longer ones.
        const double permitted = jump * std::clamp(factor, params_.slowest, params_.fastest);
        course.memory.step = jump == remaining ? std::max(course.memory.step, permitted) : permitted;
      }
      course.cycles = jump == remaining ? limit : course.cycles + jump;
      course.point = {.displacement = next.displacement, .depth = depth, .rate = next.wear_rate};
      state_ = std::move(next);
      return Status::converged;
    }
  }

  [[nodiscard]] steady::State state(const Course&) const override { return state_; }

 private:
  [[nodiscard]] bool controlled() const { return options_.tolerance > 0.0; }

  WearingJoint& joint_;
  HistoryOptions options_;
  ExplicitParams params_;
  steady::State state_;
};

}  // namespace

std::unique_ptr<Integrator> explicit_jumps(WearingJoint& joint, const HistoryOptions& options, steady::State first,
                                           const ExplicitParams& params) {
  return std::make_unique<ExplicitJumps>(joint, options, std::move(first), params);
}

}  // namespace dovetail::wear
