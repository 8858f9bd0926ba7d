#include "wear/implicit_history.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "wear/finish.hpp"
#include "wear/implicit_step.hpp"
#include "wear/measures.hpp"
#include "wear/start.hpp"

namespace dovetail::wear {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

struct Record {
  double cycles = 0;
  VectorXd depth, rate;
};

void store(const reduction::ContactNodes& contact, const std::vector<Record>& records, ImplicitHistory& result) {
  const auto count = static_cast<Index>(records.size());
  result.cycles.resize(count);
  result.worn_volume.resize(count);
  result.depth.resize(count, contact.count());
  result.rate.resize(count, contact.count());
  for (Index i = 0; i < count; ++i) {
    const Record& record = records[static_cast<std::size_t>(i)];
    result.cycles[i] = record.cycles;
    result.worn_volume[i] = worn_volume(contact, record.depth);
    result.depth.row(i) = record.depth.transpose();
    result.rate.row(i) = record.rate.transpose();
  }
}

/// Whether the rates stayed as they were while the depth doubled, far beyond the elastic scale.
bool levelled_out(const std::vector<Record>& records, double penetration, const ImplicitHistoryOptions& options) {
  return records.back().depth.maxCoeff() >= options.level_depth * penetration &&
         unchanged_while_doubling(records, options.level_change);
}

}  // namespace

ImplicitHistory implicit_history(const steady::Joint& joint, double omega, const ImplicitHistoryOptions& options,
                                 const steady::State* unworn, const Control& control, const History* past) {
  if (std::vector<Violation> wrong = violations(options, "implicit_history"); !wrong.empty())
    throw InputError(std::move(wrong));
  require_nothing_released(joint.condition);
  ImplicitHistory result;
  std::vector<Record> records;
  const auto finish = [&](HistoryEnd end, Status status) {
    result.end = end;
    result.status = within(joint.options.budget, status);
    store(joint.model->contact(), records, result);
    return std::move(result);
  };
  const bool resumed = past != nullptr && past->cycles.size() > 0;
  StepMemory& memory = result.memory;
  result.steady.omega = omega;
  if (resumed) {
    for (Index i = 0; i < past->cycles.size(); ++i)
      records.push_back(
          {.cycles = past->cycles[i], .depth = past->depth.row(i).transpose(), .rate = past->rate.row(i).transpose()});
    memory = past->memory;
    result.steady.displacement = past->steady.displacement;
  }
  if (control.stopped()) return finish(HistoryEnd::interrupted, Status::interrupted);
  steady::Joint solved = joint;
  solved.options.linearise = true;
  if (unworn != nullptr && unworn->tangent) {
    result.steady = *unworn;
  } else {
    result.steady = steady::steady_state(solved, omega, resumed ? past->steady.displacement : MatrixXd());
    result.solves = 1;
    result.jacobians = result.steady.iterations;
    result.evaluations = result.steady.evaluations;
  }
  if (result.steady.status != Status::converged) return finish(HistoryEnd::failed, result.steady.status);

  if (memory.penetration == 0.0) memory.penetration = largest_penetration(*joint.model, result.steady);
  result.largest_penetration = memory.penetration;
  WearPoint point{.displacement = result.steady.displacement,
                  .depth = joint.condition.wear_depth.size() > 0 ? joint.condition.wear_depth
                                                                 : VectorXd(VectorXd::Zero(joint.model->nodes())),
                  .rate = result.steady.wear_rate};
  const VectorXd first_depth = resumed ? VectorXd(past->depth.row(0).transpose()) : point.depth;
  double cycles = options.start_cycles;
  if (resumed) records.pop_back();  // solved again
  records.push_back({.cycles = cycles, .depth = point.depth, .rate = point.rate});
  const double start_rate = point.rate.size() > 0 ? point.rate.maxCoeff() : 0.0;
  const double first_rate = options.reference_rate > 0.0 ? options.reference_rate : start_rate;
  if (!(memory.no_wear > 0.0)) memory.no_wear = no_wear_rate(options.rate_threshold, *joint.model, result.steady);
  const double worn_out = std::max(memory.no_wear, options.rate_fraction * first_rate);
  // A resumed one may be following its tail below that.
  if (!(start_rate > (resumed ? 0.0 : worn_out))) return finish(HistoryEnd::worn_out, Status::converged);

  ImplicitStage stage(solved, result.steady);
  if (memory.factored_displacement.size() > 0)
    stage.factorise_at({.displacement = memory.factored_displacement, .depth = memory.factored_depth, .rate = {}});
  const auto count = [&] {
    memory.factored_displacement = stage.factored_at().displacement;
    memory.factored_depth = stage.factored_at().depth;
    result.solves += stage.solves();
    result.jacobians += stage.jacobians();
    result.evaluations += stage.evaluations();
  };
  const auto leave = [&](HistoryEnd end, Status status) {
    if (records.size() > 1) result.steady = stage.described(point);
    count();
    return finish(end, status);
  };
  // Early on a finish must hardly move anything: what the released nodes leave to others still has to wear in time.
  constexpr double kCloseBefore = 3e-3;
  constexpr double kCloseAtEnd = 5e-3;
  // Rate times cycles, relative to the depth, that ends a history without a finish, and the rate that ends any.
  constexpr double kNothingLeft = 1e-4;
  constexpr double kSilent = 0.1;  // of the rate that counts as none: slip far below it is noise of the samples
  if (memory.finish_below == 0.0) memory.finish_below = 1e-2;
  double jump =
      memory.step > 0.0 ? memory.step : cycle_jump(point.rate, options.first_increment * result.largest_penetration);
  const double limit = options.cycles > 0.0 ? options.cycles : kInfinity;
  // After a step whose equations could not be solved the next ones grow slowly.
  constexpr int kRecovery = 3;
  constexpr double kSlowGrowth = 1.5;
  result.jumps = memory.jumps;
  // Shortest step, relative to the depth, and how many of them a jump to another branch is long.
  constexpr double kSmallest = 1e-5;
  constexpr double kLeap = 100.0;
  constexpr int kJumps = 20;
  Status failure = Status::iteration_limit;
  for (int i = 0; i < options.steps; ++i) {
    if (control.stopped()) return leave(HistoryEnd::interrupted, Status::interrupted);
    if (spent(joint.options.budget)) return leave(HistoryEnd::failed, Status::budget_spent);
    if (cycles >= limit) return leave(HistoryEnd::cycles, Status::converged);
    const bool last_step = jump >= limit - cycles;
    memory.step = jump;
    if (last_step) jump = limit - cycles;
    WearPoint next = point;
    VectorXd error;
    failure = implicit_step(stage, jump, options.stage_iterations, next, error);
    const double scale =
        options.tolerance * std::max(result.largest_penetration, (next.depth - first_depth).maxCoeff());
    const double ratio = failure == Status::converged ? error.cwiseAbs().maxCoeff() / scale : kInfinity;
    if (!(ratio <= 1.0)) {
      ++result.rejected;
      constexpr double kCut = 0.25;
      jump *= failure == Status::converged ? std::clamp(0.9 / std::cbrt(ratio), 0.1, 0.7) : kCut;
      memory.step = jump;
      if (failure != Status::converged) memory.recovering = kRecovery;
      const double smallest = kSmallest * scale / options.tolerance;
      if (jump * point.rate.maxCoeff() >= smallest) continue;
      // The branch turns back in W, as where an amplitude jumps: a short explicit step looks for where it goes on.
      const double leap = cycle_jump(point.rate, kLeap * smallest);
      const VectorXd beyond = point.depth + leap * point.rate;
      steady::State found;
      if (result.jumps < kJumps) {
        found = steady::steady_state(solved.worn(beyond), omega, point.displacement);
        ++result.solves;
        result.jacobians += found.iterations;
        result.evaluations += found.evaluations;
      }
      if (result.jumps == kJumps || found.status != Status::converged)
        return leave(HistoryEnd::failed, failure == Status::converged ? Status::stalled : failure);
      memory.jumps = ++result.jumps;
      count();
      stage = ImplicitStage(solved, found);
      point = {.displacement = found.displacement, .depth = beyond, .rate = found.wear_rate};
      cycles += leap;
      jump = memory.step = leap;
      records.push_back({.cycles = cycles, .depth = point.depth, .rate = point.rate});
      continue;
    }
    point = std::move(next);
    cycles = last_step ? limit : cycles + jump;
    records.push_back({.cycles = cycles, .depth = point.depth, .rate = point.rate});
    control.report(static_cast<int>(records.size()) - 1, worn_volume(joint.model->contact(), point.depth),
                   point.rate.maxCoeff());
    const double fastest = point.rate.maxCoeff();
    const bool quiet = fastest <= worn_out;
    if (quiet && !options.finish) {
      result.steady = stage.described(point);
      count();
      return finish(HistoryEnd::worn_out, Status::converged);
    }
    if (quiet || fastest <= memory.finish_below * first_rate) {
      const steady::State reached = stage.described(point);
      Finish last;
      if (fastest <= memory.finish_below * first_rate) {
        last = finish_by_release(joint, reached, point.depth, cycles, quiet ? kCloseAtEnd : kCloseBefore, control);
        result.solves += last.solves;
        result.jacobians += last.jacobians;
        memory.finish_below = 0.1 * fastest / first_rate;
      }
      // Where finishing is no way out the tail is followed until it leaves nothing.
      const double left = fastest * cycles / point.depth.maxCoeff();
      if (last.done || (quiet && (left <= kNothingLeft || fastest <= kSilent * worn_out))) {
        result.steady = last.done ? last.steady : reached;
        result.finished = last.done;
        count();
        if (last.done) {
          result.finish_change = (last.depth - point.depth).cwiseAbs().maxCoeff();
          records.push_back({.cycles = kInfinity, .depth = last.depth, .rate = last.steady.wear_rate});
        }
        return finish(HistoryEnd::worn_out, Status::converged);
      }
    }
    if (levelled_out(records, result.largest_penetration, options))
      return leave(HistoryEnd::steady_rate, Status::converged);
    jump *=
        std::clamp(0.9 / std::cbrt(std::max(ratio, 1e-6)), 0.3, memory.recovering > 0 ? kSlowGrowth : options.growth);
    memory.recovering = std::max(0, memory.recovering - 1);
    memory.step = last_step ? std::max(jump, memory.step) : jump;
  }
  if (cycles >= limit) return leave(HistoryEnd::cycles, Status::converged);
  return leave(HistoryEnd::steps, failure == Status::converged ? Status::iteration_limit : failure);
}

History as_history(const ImplicitHistory& implicit, const dynamics::CondensedModel& model) {
  const Index count = implicit.cycles.size() - (implicit.finished ? 1 : 0);
  History history{
      .status = implicit.status,
      .end = implicit.end,
      .cycles = implicit.cycles.head(count),
      .worn_volume = implicit.worn_volume.head(count),
      .depth = implicit.depth.topRows(count),
      .rate = implicit.rate.topRows(count),
      .amplitude = VectorXd::Constant(count, std::nan("")),
      .frequency = VectorXd::Constant(count, implicit.steady.omega),
      .steady = implicit.steady,
      .final_depth = implicit.depth.rows() > 0 ? VectorXd(implicit.depth.bottomRows(1).transpose())
                                               : VectorXd(VectorXd::Zero(model.nodes())),
      .final_rate = implicit.rate.rows() > 0 ? VectorXd(implicit.rate.bottomRows(1).transpose()) : VectorXd(),
      .finished = implicit.finished,
      .memory = implicit.memory,
      .solves = implicit.solves,
      .jacobians = implicit.jacobians,
      .rejected = implicit.rejected};
  history.final_volume = worn_volume(model.contact(), history.final_depth);
  if (count > 0 && implicit.steady.amplitudes.size() > 0) history.amplitude[count - 1] = implicit.steady.amplitudes[0];
  return history;
}

}  // namespace dovetail::wear
