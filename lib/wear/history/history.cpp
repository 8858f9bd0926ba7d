#include "wear/history/history.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "wear/history/finish_by_release.hpp"
#include "wear/history/integrator.hpp"
#include "wear/history/steady_rate.hpp"
#include "wear/measures.hpp"
#include "wear/params.hpp"
#include "wear/wearing_joint.hpp"

namespace dovetail::wear {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

std::vector<WornRecord> records_of(const History& past) {
  std::vector<WornRecord> records;
  for (Index i = 0; i < past.cycles.size(); ++i)
    records.push_back({.cycles = past.cycles[i],
                       .volume = past.worn_volume[i],
                       .amplitude = past.amplitude.size() > i ? past.amplitude[i] : std::nan(""),
                       .frequency = past.frequency[i],
                       .depth = past.depth.row(i).transpose(),
                       .rate = past.rate.row(i).transpose()});
  return records;
}

void store(const std::vector<WornRecord>& records, Index nodes, History& result) {
  const auto count = static_cast<Index>(records.size());
  for (VectorXd* list : {&result.cycles, &result.worn_volume, &result.amplitude, &result.frequency})
    list->resize(count);
  result.depth.resize(count, nodes);
  result.rate.resize(count, nodes);
  for (Index i = 0; i < count; ++i) {
    const WornRecord& record = records[static_cast<std::size_t>(i)];
    result.cycles[i] = record.cycles;
    result.worn_volume[i] = record.volume;
    result.amplitude[i] = record.amplitude;
    result.frequency[i] = record.frequency;
    result.depth.row(i) = record.depth.transpose();
    result.rate.row(i) = record.rate.transpose();
  }
}

/// The one loop of wear: depth -> state -> rate -> depth.
class Loop {
 public:
  Loop(const steady::Joint& joint, const HistoryStart& start, const HistoryOptions& options, const Watcher& watcher)
      : start_(start),
        options_(options),
        watcher_(watcher),
        finish_(implicit() ? kFinishImplicit : kFinishExplicit),
        limit_(options.cycles > 0.0 ? options.cycles : kInfinity),
        wearing_(begun(joint, start), start.omega, watcher) {
    if (options.follow == Follow::resonance) wearing_.follow(start.resonance);
  }

  [[nodiscard]] History run() {
    if (resumed()) {
      records_ = records_of(*start_.past);
      result_.steady.displacement = start_.past->steady.displacement;
      course_.memory = start_.past->memory;
    }
    if (const Status status = begin(); status != Status::converged) return ended(end_of(status), status);
    // A resumed one may be following its tail.
    if (largest(course_.point.rate) <= (resumed() ? 0.0 : worn_out_)) return ended(HistoryEnd::worn_out);
    for (int step = 0; step < options_.steps && course_.cycles < limit_; ++step) {
      const Status status = integrator_->advance(limit_, course_);
      if (status != Status::converged) return ended(end_of(status), status);
      state_.reset();
      record();
      watcher_.report(static_cast<int>(records_.size()) - 1, records_.back().volume, largest(course_.point.rate));
      if (at_rest()) return ended(HistoryEnd::worn_out);
      if (levelled_out()) return ended(HistoryEnd::steady_rate);
    }
    return ended(course_.cycles >= limit_ ? HistoryEnd::cycles : HistoryEnd::steps);
  }

 private:
  [[nodiscard]] bool implicit() const { return options_.integrator == IntegratorKind::implicit_steps; }
  [[nodiscard]] bool resumed() const { return start_.past != nullptr && start_.past->cycles.size() > 0; }
  [[nodiscard]] static HistoryEnd end_of(Status status) {
    return status == Status::interrupted ? HistoryEnd::interrupted : HistoryEnd::failed;
  }

  [[nodiscard]] static steady::Joint begun(const steady::Joint& joint, const HistoryStart& start) {
    const bool resumed = start.past != nullptr && start.past->cycles.size() > 0;
    steady::Joint worn = resumed ? joint.worn(start.past->depth.bottomRows(1).transpose()) : joint;
    worn.options.linearise = true;
    return worn;
  }

  [[nodiscard]] Status begin() {
    const VectorXd& depth = wearing_.start();
    steady::State first = start_.unworn != nullptr && start_.unworn->tangent && !resumed()
                              ? *start_.unworn
                              : wearing_.worn(depth, result_.steady.displacement);
    if (first.status != Status::converged) return first.status;
    course_.point = {.displacement = first.displacement, .depth = depth, .rate = first.wear_rate};
    if (resumed() && implicit() && !start_.past->finished &&
        start_.past->steady.displacement.size() == first.displacement.size())
      course_.point = {.displacement = start_.past->steady.displacement, .depth = depth, .rate = records_.back().rate};
    course_.first_depth = resumed() ? VectorXd(records_.front().depth) : depth;
    course_.cycles = resumed() ? records_.back().cycles : 0.0;
    if (resumed()) records_.pop_back();  // solved again
    reference_ = largest(records_.empty() ? first.wear_rate : records_.front().rate);
    StepMemory& memory = course_.memory;
    if (memory.penetration == 0.0) memory.penetration = largest_penetration(wearing_.model(), first);
    if (!(memory.no_wear > 0.0)) memory.no_wear = no_wear_rate(options_.rate_threshold, wearing_.model(), first);
    if (memory.finish_below == 0.0) memory.finish_below = finish_.below;
    worn_out_ = std::max(memory.no_wear, options_.rate_fraction * reference_);
    integrator_ =
        implicit() ? implicit_steps(wearing_, options_, first, memory) : explicit_jumps(wearing_, options_, first);
    state_ = std::move(first);
    record();
    return Status::converged;
  }

  const steady::State& state() {
    if (!state_) state_ = integrator_->state(course_);
    return *state_;
  }

  void record() {
    WornRecord record{.cycles = course_.cycles,
                      .volume = worn_volume(wearing_.model().contact(), course_.point.depth),
                      .amplitude = std::nan(""),
                      .frequency = start_.omega,
                      .depth = course_.point.depth,
                      .rate = course_.point.rate};
    if (!implicit()) record.frequency = state().omega;
    if (!implicit()) record.amplitude = amplitude(state());
    records_.push_back(std::move(record));
  }

  [[nodiscard]] double amplitude(const steady::State& state) const {
    const Index output = start_.resonance.output;
    return state.amplitudes.size() > output ? state.amplitudes[output] : 0.0;
  }

  /// Whether wear is over; where the direct method finishes it, the result is finished.
  [[nodiscard]] bool at_rest() {
    double& below = course_.memory.finish_below;
    const double fastest = largest(course_.point.rate);
    const bool quiet = fastest <= worn_out_;
    const bool early = fastest <= below * reference_;
    if (!options_.finish || options_.follow == Follow::resonance) return quiet;
    if (early || (quiet && !finish_.follows_tail)) {
      finish(quiet ? finish_.close_at_end : finish_.close_before);
      if (result_.finished) return true;
      if (finish_.follows_tail) below = finish_.again * fastest / reference_;
    }
    if (!quiet || !finish_.follows_tail) return quiet;
    const double left = fastest * course_.cycles / course_.point.depth.maxCoeff();
    return left <= finish_.nothing_left || fastest <= finish_.silent * worn_out_;
  }

  void finish(double close) {
    Finish last = finish_by_release(wearing_.joint(), state(), course_.point.depth, course_.cycles, close, watcher_);
    wearing_.count(last.solves, last.jacobians);
    if (!last.done) return;
    result_.finished = true;
    result_.final_depth = std::move(last.depth);
    result_.final_rate = last.steady.wear_rate;
    result_.steady = std::move(last.steady);
  }

  /// Whether rates have stayed as they were while the depth doubled, and will. Who asks for cycles gets them.
  [[nodiscard]] bool levelled_out() {
    if (limit_ < kInfinity || !unchanged_while_doubling(records_)) return false;
    const double far = LevelParams{}.depth * course_.memory.penetration;
    return course_.point.depth.maxCoeff() >= far || insensitive_to_wear(state(), far);
  }

  [[nodiscard]] History ended(HistoryEnd end, Status status = Status::converged) {
    result_.end = end;
    result_.status = within(wearing_.joint().options.budget, status);
    if (!result_.finished) {
      const bool over = end == HistoryEnd::worn_out || end == HistoryEnd::steady_rate;
      if (integrator_) result_.steady = over ? state() : integrator_->as_stepped(course_);
      result_.final_depth = records_.empty() ? wearing_.start() : records_.back().depth;
      if (!records_.empty()) result_.final_rate = records_.back().rate;
    }
    if (implicit() && integrator_) records_.back().amplitude = amplitude(result_.steady);
    store(records_, wearing_.model().nodes(), result_);
    result_.final_volume = worn_volume(wearing_.model().contact(), result_.final_depth);
    result_.memory = course_.memory;
    result_.rejected = course_.rejected;
    result_.solves = wearing_.solves();
    result_.jacobians = wearing_.jacobians();
    return std::move(result_);
  }

  HistoryStart start_;
  HistoryOptions options_;
  Watcher watcher_;
  FinishParams finish_;
  double limit_;
  WearingJoint wearing_;
  Course course_;
  std::unique_ptr<Integrator> integrator_;
  std::optional<steady::State> state_;  // of the last accepted point, when asked for
  std::vector<WornRecord> records_;
  double reference_ = 0.0;  // largest rate of the first state
  double worn_out_ = 0.0;   // rate that counts as none
  History result_;
};

}  // namespace

double Course::error_scale(const VectorXd& depth) const {
  return std::max(memory.penetration, (depth - first_depth).maxCoeff());
}

History history(const steady::Joint& joint, const HistoryStart& start, const HistoryOptions& options,
                const Watcher& watcher) {
  std::vector<Violation> wrong = violations(options, "history");
  const bool implicit = options.integrator == IntegratorKind::implicit_steps;
  if (implicit) {
    if (!(options.tolerance > 0.0))
      wrong.push_back(
          {.file = {}, .key = "history.tolerance", .value = "0", .allowed = "must be > 0 for implicit steps"});
    if (options.follow == Follow::resonance)
      wrong.push_back({.file = {},
                       .key = "history.follow",
                       .value = std::string(to_string(options.follow)),
                       .allowed = "must be fixed for implicit steps"});
  }
  if (!wrong.empty()) throw InputError(std::move(wrong));
  if (implicit) require_nothing_released(joint.condition);
  return Loop(joint, start, options, watcher).run();
}

}  // namespace dovetail::wear
