#include <algorithm>
#include <cmath>
#include <utility>

#include "wear/history/implicit_step.hpp"
#include "wear/history/integrator.hpp"
#include "wear/measures.hpp"

namespace dovetail::wear {

namespace {

using Eigen::VectorXd;

class ImplicitSteps : public Integrator {
 public:
  ImplicitSteps(WearingJoint& joint, const HistoryOptions& options, steady::State first, const StepMemory& memory,
                const ImplicitParams& params)
      : joint_(joint),
        options_(options),
        params_(params),
        stage_(joint.joint(), first, params.stage * options.tolerance) {
    if (memory.factored_displacement.size() > 0)
      stage_.factorise_at({.displacement = memory.factored_displacement,
                           .depth = memory.factored_depth,
                           .cycles = memory.factored_cycles});
    first_ = std::move(first);
  }

  [[nodiscard]] Status advance(double limit, Course& course) override {
    StepMemory& memory = course.memory;
    if (memory.step == 0.0) memory.step = cycle_jump(course.point.rate, params_.first_increment * memory.penetration);
    for (;;) {
      if (joint_.watcher().stopped()) return Status::interrupted;
      if (spent(joint_.joint().options.budget)) return Status::budget_spent;
      const bool last = memory.step >= limit - course.cycles;
      const double jump = last ? limit - course.cycles : memory.step;
      WearPoint next = course.point;
      VectorXd error;
      const Status status = stepped(jump, next, error);
      const double scale = course.error_scale(next.depth);
      const double ratio =
          status == Status::converged ? error.cwiseAbs().maxCoeff() / (options_.tolerance * scale) : kInfinity;
      if (ratio <= 1.0) {
        course.point = std::move(next);
        course.cycles = last ? limit : course.cycles + jump;
        const double growth = memory.recovering > 0 ? params_.slow_growth : params_.growth;
        const double longer =
            jump * std::clamp(params_.safety / std::cbrt(std::max(ratio, 1e-6)), params_.shrinking, growth);
        memory.step = last ? std::max(longer, memory.step) : longer;
        memory.recovering = std::max(0, memory.recovering - 1);
        memory.factored_displacement = stage_.factored_at().displacement;
        memory.factored_depth = stage_.factored_at().depth;
        memory.factored_cycles = stage_.factored_at().cycles;
        first_ = {};
        return Status::converged;
      }
      ++course.rejected;
      const bool solved = status == Status::converged;
      memory.step =
          jump * (solved ? std::clamp(params_.safety / std::cbrt(ratio), params_.shortest_cut, params_.longest_cut)
                         : params_.unsolved_cut);
      if (!solved) memory.recovering = params_.recovery;
      const double smallest = params_.smallest * scale;
      if (memory.step * course.point.rate.maxCoeff() >= smallest) continue;
      return leap(params_.leap * smallest, limit, course) ? Status::converged : solved ? Status::stalled : status;
    }
  }

  [[nodiscard]] steady::State state(const Course& course) const override {
    if (first_.displacement.size() > 0) return first_;
    // A stage is less exact than a state.
    steady::State exact = joint_.worn(course.point.depth, course.point.displacement);
    return exact.status == Status::converged ? exact : as_stepped(course);
  }

  [[nodiscard]] steady::State as_stepped(const Course& course) const override {
    return first_.displacement.size() > 0 ? first_ : stage_.described(course.point);
  }

 private:
  [[nodiscard]] Status stepped(double jump, WearPoint& next, VectorXd& error) {
    stage_.begin_step();
    const int solves = stage_.solves(), jacobians = stage_.jacobians();
    const Status status = implicit_step(stage_, jump, params_.stage_iterations, next, error);
    joint_.count(stage_.solves() - solves, stage_.jacobians() - jacobians);
    return status;
  }

  /// The branch turns back in W, as where an amplitude jumps: a short explicit jump looks for where it goes on.
  [[nodiscard]] bool leap(double increment, double limit, Course& course) {
    StepMemory& memory = course.memory;
    if (memory.jumps == params_.jumps) return false;
    const double cycles = std::min(cycle_jump(course.point.rate, increment), limit - course.cycles);
    const VectorXd beyond = course.point.depth + cycles * course.point.rate;
    steady::State found = joint_.worn(beyond, course.point.displacement);
    if (found.status != Status::converged) return false;
    ++memory.jumps;
    memory.step = cycles;
    stage_ = ImplicitStage(joint_.joint(), found, params_.stage * options_.tolerance);
    memory.factored_displacement = {};
    memory.factored_depth = {};
    memory.factored_cycles = {};
    course.point = {.displacement = found.displacement, .depth = beyond, .rate = found.wear_rate};
    course.cycles += cycles;
    first_ = std::move(found);
    return true;
  }

  WearingJoint& joint_;
  HistoryOptions options_;
  ImplicitParams params_;
  ImplicitStage stage_;
  steady::State first_;  // the state at the point while no step has left it, else empty
};

}  // namespace

std::unique_ptr<Integrator> implicit_steps(WearingJoint& joint, const HistoryOptions& options, steady::State first,
                                           const StepMemory& memory, const ImplicitParams& params) {
  return std::make_unique<ImplicitSteps>(joint, options, std::move(first), memory, params);
}

}  // namespace dovetail::wear
