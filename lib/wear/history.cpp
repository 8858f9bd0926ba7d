#include "wear/history.hpp"

#include <algorithm>
#include <vector>

#include "wear/archard.hpp"

namespace dovetail::wear {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// One state of a history as solved, at the fixed frequency or at the resonance of this wear.
struct Solved {
  Status status = Status::converged;
  response::SteadyState state;
  int solves = 0;
  int jacobians = 0;
};

struct Record {
  double cycles = 0, volume = 0, amplitude = 0, frequency = 0;
  VectorXd depth, rate;
};

class Run {
 public:
  Run(std::shared_ptr<const response::CondensedModel> model, const response::ContactCondition& start,
      const response::SteadyOptions& steady, const HistoryOptions& options, const response::ResonanceOptions& resonance)
      : model_(std::move(model)), condition_(start), steady_(steady), options_(options), resonance_(resonance) {
    if (condition_.wear_depth.size() == 0) condition_.wear_depth = VectorXd::Zero(model_->nodes());
    resonance_.sweep_range = 0;  // the peak is followed: one found elsewhere would not be the same
  }

  [[nodiscard]] const VectorXd& depth() const { return condition_.wear_depth; }

  [[nodiscard]] Solved solve(double omega, const VectorXd& depth, const MatrixXd& guess,
                             const std::shared_ptr<const response::Linearisation>& reuse = {}) const {
    response::ContactCondition condition = condition_;
    condition.wear_depth = depth;
    Solved solved;
    if (options_.follow == "resonance") {
      response::Resonance found = response::resonance(model_, omega, condition, steady_, resonance_, guess);
      solved.status = found.status;
      solved.solves = found.solves;
      solved.jacobians = found.jacobians;
      solved.state = std::move(found.state);
    } else {
      solved.state = response::steady_state(model_, omega, condition, steady_, guess, reuse);
      solved.status = solved.state.status;
      solved.solves = 1;
      solved.jacobians = solved.state.iterations;
    }
    return solved;
  }

  void accept(const VectorXd& depth, const response::SteadyState& state) {
    condition_.wear_depth = depth;
    if (options_.carry_slip) condition_.slip_origin = state.slip_end;
  }

  [[nodiscard]] Record record(double cycles, const response::SteadyState& state) const {
    return {.cycles = cycles,
            .volume = worn_volume(model_->contact(), depth()),
            .amplitude = state.amplitudes.size() > resonance_.output ? state.amplitudes[resonance_.output] : 0.0,
            .frequency = state.omega,
            .depth = depth(),
            .rate = state.wear_rate};
  }

 private:
  std::shared_ptr<const response::CondensedModel> model_;
  response::ContactCondition condition_;
  response::SteadyOptions steady_;
  HistoryOptions options_;
  response::ResonanceOptions resonance_;
};

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

History history(const std::shared_ptr<const response::CondensedModel>& model, double omega,
                const response::ContactCondition& start, const response::SteadyOptions& steady,
                const HistoryOptions& options, const response::ResonanceOptions& resonance, const Control& control) {
  if (std::vector<Violation> wrong = violations(options, "history"); !wrong.empty()) throw InputError(std::move(wrong));

  Run run(model, start, steady, options, resonance);
  History result;
  std::vector<Record> records;
  const auto count = [&result](const Solved& solved) {
    result.solves += solved.solves;
    result.jacobians += solved.jacobians;
  };
  const auto finish = [&](HistoryEnd end, Status status) {
    result.end = end;
    result.status = status;
    store(records, model->nodes(), result);
    return std::move(result);
  };

  if (control.stopped()) return finish(HistoryEnd::interrupted, Status::interrupted);
  Solved current = run.solve(omega, run.depth(), {});
  count(current);
  if (current.status != Status::converged) return finish(HistoryEnd::failed, current.status);
  run.accept(run.depth(), current.state);
  const double limit = options.cycles > 0.0 ? options.cycles : kInfinity;
  double cycles = 0.0;
  records.push_back(run.record(cycles, current.state));
  result.steady = current.state;
  const double worn_out = std::max(options.rate_threshold, options.rate_fraction * current.state.wear_rate.maxCoeff());

  for (int step = 1; step <= options.steps; ++step) {
    const VectorXd rate = result.steady.wear_rate;
    const double largest = rate.maxCoeff();
    if (largest <= worn_out) return finish(HistoryEnd::worn_out, Status::converged);
    const double remaining = limit - cycles;
    if (remaining <= 0.0) return finish(HistoryEnd::cycles, Status::converged);
    double jump = std::min(cycle_jump(rate, options.increment), remaining);

    Solved next;
    for (int halving = 0;; ++halving, jump *= 0.5) {
      if (control.stopped()) return finish(HistoryEnd::interrupted, Status::interrupted);
      const VectorXd change = jump * rate;
      MatrixXd guess = result.steady.displacement;
      if (options.predictor && result.steady.linearisation)
        guess += result.steady.linearisation->response_to_wear(change);
      next = run.solve(result.steady.omega, run.depth() + change, guess, result.steady.linearisation);
      count(next);
      if (next.status == Status::converged) {
        run.accept(run.depth() + change, next.state);
        break;
      }
      ++result.rejected;
      if (halving == options.halvings) return finish(HistoryEnd::failed, next.status);
    }
    cycles = jump == remaining ? limit : cycles + jump;
    result.steady = std::move(next.state);
    records.push_back(run.record(cycles, result.steady));
    control.report(step, records.back().volume, records.back().rate.maxCoeff());
  }
  const bool done = result.steady.wear_rate.maxCoeff() <= worn_out;
  return finish(done ? HistoryEnd::worn_out : HistoryEnd::steps, Status::converged);
}

}  // namespace dovetail::wear
