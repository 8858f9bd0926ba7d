#include "wear/history.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "wear/finish.hpp"
#include "wear/measures.hpp"
#include "wear/steady_rate.hpp"

namespace dovetail::wear {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// One state of a history as solved, at the fixed frequency or at the resonance of this wear.
struct Solved {
  Status status = Status::converged;
  steady::State state;
  int solves = 0;
  int jacobians = 0;
};

struct Record {
  double cycles = 0, volume = 0, amplitude = 0, frequency = 0;
  VectorXd depth, rate;
};

class Run {
 public:
  Run(const steady::Joint& joint, const HistoryOptions& options, const paths::ResonanceOptions& resonance)
      : joint_(joint), options_(options), resonance_(resonance) {
    if (depth().size() == 0) joint_.condition.wear_depth = VectorXd::Zero(joint_.model->nodes());
    resonance_.sweep_range = 0;  // the peak is followed: one found elsewhere would not be the same
  }

  [[nodiscard]] const VectorXd& depth() const { return joint_.condition.wear_depth; }

  [[nodiscard]] Solved solve(double omega, const VectorXd& depth, const MatrixXd& guess,
                             const std::shared_ptr<const steady::Tangent>& reuse = {}) const {
    Solved solved;
    if (options_.follow == "resonance") {
      paths::Resonance found = paths::resonance(joint_.worn(depth), omega, resonance_, guess);
      solved.status = found.status;
      solved.solves = found.solves;
      solved.jacobians = found.jacobians;
      solved.state = std::move(found.state);
    } else {
      solved.state = steady::steady_state(joint_.worn(depth), omega, guess, reuse);
      solved.status = solved.state.status;
      solved.solves = 1;
      solved.jacobians = solved.state.iterations;
    }
    return solved;
  }

  [[nodiscard]] const steady::Joint& joint() const { return joint_; }

  void accept(const VectorXd& depth, const steady::State& state) {
    joint_.condition.wear_depth = depth;
    if (options_.carry_slip) joint_.condition.slip_origin = state.slip_end;
  }

  [[nodiscard]] Record record(double cycles, const steady::State& state) const {
    return {.cycles = cycles,
            .volume = worn_volume(joint_.model->contact(), depth()),
            .amplitude = state.amplitudes.size() > resonance_.output ? state.amplitudes[resonance_.output] : 0.0,
            .frequency = state.omega,
            .depth = depth(),
            .rate = state.wear_rate};
  }

 private:
  steady::Joint joint_;
  HistoryOptions options_;
  paths::ResonanceOptions resonance_;
};

std::vector<Record> states_of(const History& past) {
  std::vector<Record> records;
  for (Index i = 0; i < past.cycles.size(); ++i)
    records.push_back({.cycles = past.cycles[i],
                       .volume = past.worn_volume[i],
                       .amplitude = past.amplitude.size() > i ? past.amplitude[i] : std::nan(""),
                       .frequency = past.frequency[i],
                       .depth = past.depth.row(i).transpose(),
                       .rate = past.rate.row(i).transpose()});
  return records;
}

void store(const std::vector<Record>& records, Index nodes, History& result) {
  const auto count = static_cast<Index>(records.size());
  result.cycles.resize(count);
  result.worn_volume.resize(count);
  result.amplitude.resize(count);
  result.frequency.resize(count);
  result.depth.resize(count, nodes);
  result.rate.resize(count, nodes);
  for (Index i = 0; i < count; ++i) {
    const Record& record = records[static_cast<std::size_t>(i)];
    result.cycles[i] = record.cycles;
    result.worn_volume[i] = record.volume;
    result.amplitude[i] = record.amplitude;
    result.frequency[i] = record.frequency;
    result.depth.row(i) = record.depth.transpose();
    result.rate.row(i) = record.rate.transpose();
  }
}

}  // namespace

std::string_view to_string(HistoryEnd end) {
  switch (end) {
    case HistoryEnd::worn_out:
      return "worn_out";
    case HistoryEnd::steady_rate:
      return "steady_rate";
    case HistoryEnd::cycles:
      return "cycles";
    case HistoryEnd::steps:
      return "steps";
    case HistoryEnd::failed:
      return "failed";
    case HistoryEnd::interrupted:
      return "interrupted";
  }
  return "unknown";
}

Resumption resume(const History& stored, const steady::Joint& joint, const HistoryOptions& options) {
  const Index last = stored.cycles.size() - 1;
  Resumption next{
      .omega = stored.frequency.size() > 0 ? stored.frequency[last] : 0.0, .joint = joint, .options = options};
  if (last < 0) return next;
  next.joint.condition.wear_depth = stored.depth.row(last).transpose();
  if (options.carry_slip) next.joint.condition.slip_origin = stored.steady.slip_end;
  next.options.start_cycles = stored.cycles[last];
  if (options.reference_rate == 0.0 && stored.rate.size() > 0)
    next.options.reference_rate = stored.rate.row(0).maxCoeff();
  return next;
}

History history(const steady::Joint& joint, double omega, const HistoryOptions& options,
                const paths::ResonanceOptions& resonance, const Control& control, const StateObserver& observer,
                const History* past) {
  if (std::vector<Violation> wrong = violations(options, "history"); !wrong.empty()) throw InputError(std::move(wrong));

  Run run(joint, options, resonance);
  History result;
  std::vector<Record> records;
  const auto count = [&result](const Solved& solved) {
    result.solves += solved.solves;
    result.jacobians += solved.jacobians;
  };
  const auto finish = [&](HistoryEnd end, Status status) {
    result.end = end;
    result.status = status;
    store(records, joint.model->nodes(), result);
    result.final_depth = run.depth();
    if (!records.empty()) result.final_rate = records.back().rate;
    if (end == HistoryEnd::worn_out && options.finish && options.follow == "fixed" && records.size() > 1) {
      constexpr double kClose = 0.05;
      const Finish last =
          finish_by_release(run.joint(), result.steady, run.depth(), records.back().cycles, kClose, control);
      result.solves += last.solves;
      result.jacobians += last.jacobians;
      result.finished = last.done;
      if (last.done) {
        result.final_depth = last.depth;
        result.final_rate = last.steady.wear_rate;
      }
    }
    result.final_volume = worn_volume(joint.model->contact(), result.final_depth);
    return std::move(result);
  };
  const auto accept = [&](double cycles, const VectorXd& depth) {
    run.accept(depth, result.steady);
    records.push_back(run.record(cycles, result.steady));
    if (observer) observer(static_cast<int>(records.size()) - 1, cycles, run.joint().condition, result.steady);
  };

  const bool resumed = past != nullptr && past->cycles.size() > 0;
  if (resumed) {
    records = states_of(*past);
    result.memory = past->memory;
    result.steady.displacement = past->steady.displacement;
  }
  if (control.stopped()) return finish(HistoryEnd::interrupted, Status::interrupted);
  Solved current = run.solve(omega, run.depth(), resumed ? past->steady.displacement : MatrixXd());
  count(current);
  if (current.status != Status::converged) return finish(HistoryEnd::failed, current.status);
  const double limit = options.cycles > 0.0 ? options.cycles : kInfinity;
  if (resumed) records.pop_back();  // solved again
  const VectorXd first_depth = resumed ? VectorXd(past->depth.row(0).transpose()) : run.depth();
  double cycles = options.start_cycles;
  result.steady = std::move(current.state);
  accept(cycles, VectorXd(run.depth()));
  const double reference = options.reference_rate > 0.0 ? options.reference_rate : result.steady.wear_rate.maxCoeff();
  if (!(result.memory.no_wear > 0.0))
    result.memory.no_wear = no_wear_rate(options.rate_threshold, *joint.model, result.steady);
  const double worn_out = std::max(result.memory.no_wear, options.rate_fraction * reference);
  if (result.memory.penetration == 0.0) result.memory.penetration = largest_penetration(*joint.model, result.steady);
  const double penetration = result.memory.penetration;
  double longest = options.tolerance > 0.0 && result.memory.step > 0.0
                       ? result.memory.step
                       : kInfinity;  // jump the last step's error permits

  for (int step = 1; step <= options.steps; ++step) {
    const VectorXd rate = result.steady.wear_rate;
    if (rate.size() == 0 || rate.maxCoeff() <= worn_out) return finish(HistoryEnd::worn_out, Status::converged);
    const double remaining = limit - cycles;
    if (remaining <= 0.0) return finish(HistoryEnd::cycles, Status::converged);
    double jump = std::min({cycle_jump(rate, options.increment), remaining, longest});

    Solved next;
    VectorXd change;
    for (int halving = 0;;) {
      if (control.stopped()) return finish(HistoryEnd::interrupted, Status::interrupted);
      change = jump * rate;
      MatrixXd guess = result.steady.displacement;
      if (options.predictor && result.steady.tangent) guess += result.steady.tangent->response_to_wear(change);
      next = run.solve(result.steady.omega, run.depth() + change, guess, result.steady.tangent);
      count(next);
      if (next.status != Status::converged) {
        ++result.rejected;
        if (halving++ == options.halvings) return finish(HistoryEnd::failed, next.status);
        jump *= 0.5;
        continue;
      }
      if (options.tolerance == 0.0) break;
      const double scale = std::max(penetration, (run.depth() + change - first_depth).maxCoeff());
      const double error = 0.5 * jump * (next.state.wear_rate - rate).cwiseAbs().maxCoeff() / scale;
      const double factor = 0.9 * std::sqrt(options.tolerance / std::max(error, 1e-300));
      constexpr double kLeast = 1e-3;  // of the increment: a jump of the rates cannot be resolved
      if (error > options.tolerance && change.maxCoeff() > kLeast * options.increment) {
        ++result.rejected;
        jump *= std::clamp(factor, 0.1, 0.8);
        continue;
      }
      // A step cut to end at the cycles asked for says nothing against longer ones.
      const double permitted = jump * std::clamp(factor, 0.5, 2.0);
      longest = jump == remaining && std::isfinite(longest) ? std::max(longest, permitted) : permitted;
      result.memory.step = longest;
      break;
    }
    cycles = jump == remaining ? limit : cycles + jump;
    result.steady = std::move(next.state);
    accept(cycles, run.depth() + change);
    control.report(step, records.back().volume, records.back().rate.maxCoeff());
    // Who asks for a number of cycles gets them.
    if (limit == kInfinity && unchanged_while_doubling(records, kLevelChange) &&
        insensitive_to_wear(result.steady, kLevelDepth * penetration, kLevelChange))
      return finish(HistoryEnd::steady_rate, Status::converged);
  }
  const bool done = result.steady.wear_rate.maxCoeff() <= worn_out;
  return finish(done ? HistoryEnd::worn_out : HistoryEnd::steps, Status::converged);
}

}  // namespace dovetail::wear
