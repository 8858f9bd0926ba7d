#include "response/continuation.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "response/branch.hpp"

namespace dovetail::response {
namespace {

double vibration(const Eigen::MatrixXd& coefficients) {
  return coefficients.rightCols(coefficients.cols() - 1).norm();
}

BranchVector difference(const BranchVector& a, const BranchVector& b) {
  return {.displacement = a.displacement - b.displacement, .omega = a.omega - b.omega};
}

BranchVector along(const BranchVector& from, const BranchVector& direction, double step) {
  return {.displacement = from.displacement + step * direction.displacement,
          .omega = from.omega + step * direction.omega};
}

// A point of the branch with what the next step needs: the unit tangent and the metric in which it is one.
struct Station {
  BranchVector at;
  BranchVector tangent;
  ArcMetric metric;
  SteadyState state;
  double step = 0;           // arc length from the station before
  double turn_angle = 0;     // between its tangent and the one before, rad
  double output_change = 0;  // from the station before, relative
  int iterations = 0;
  int orientation = 0;    // sign of det J times that of d omega / ds along the way; 0: not known
  bool doubtful = false;  // det J and the way come disagree on where onwards is
};

class Follower {
 public:
  Follower(const std::shared_ptr<const CondensedModel>& model, double from, double to,
           const ContactCondition& condition, const SteadyOptions& options, const ContinuationOptions& follow,
           const std::function<bool(const ContinuationPoint&)>& progress)
      : model_(model),
        condition_(condition),
        options_(options),
        follow_(follow),
        progress_(progress),
        from_(from),
        to_(to) {}

  Branch run(const Eigen::MatrixXd& guess) {
    if (!start(guess)) return std::move(branch_);
    double step = std::min(follow_.initial_step, follow_.largest_change);
    while (static_cast<int>(branch_.points.size()) < follow_.max_points) {
      std::optional<Station> next = advance(step);
      // A kink turns the tangent by the same angle however short the step: a short one is taken as it is.
      constexpr double kShort = 0.03;
      const bool coarse = next && (next->doubtful || !fine(*next)) && step > kShort * follow_.largest_change;
      if (next && !coarse) {
        if (const std::optional<double> end = end_passed(next->at.omega)) {
          if (finish_at(*end, *next)) return std::move(branch_);
          next.reset();
        }
      }
      if (!next || coarse) {
        ++branch_.rejected;
        step *= coarse && !next->doubtful ? std::clamp(0.8 * shape_factor(*next), 0.2, 0.7) : 0.4;
        if (step < follow_.smallest_step) return finish(failure_ == Status::converged ? Status::stalled : failure_);
        continue;
      }
      if (follow_.locate_turns && next->tangent.omega * now_.tangent.omega < 0 && !place_turn(*next))
        return finish(Status::interrupted);
      step = next_step(*next, step);
      if (!accept(std::move(*next), false)) return finish(Status::interrupted);
    }
    return finish(Status::iteration_limit);
  }

 private:
  bool start(const Eigen::MatrixXd& guess) {
    SteadyOptions with_linearisation = options_;
    with_linearisation.linearise = true;
    SteadyState state = steady_state(model_, from_, condition_, with_linearisation, guess);
    branch_.jacobians = state.iterations;
    branch_.evaluations = state.evaluations;
    branch_.penalty_ratio = state.penalty_ratio;
    branch_.status = state.status;
    if (state.status != Status::converged) {
      branch_.points.push_back({.state = std::move(state)});
      return false;
    }
    equations_.emplace(model_, condition_, options_, state.penalty_ratio);
    now_.at = {.displacement = state.displacement, .omega = from_};
    now_.state = std::move(state);
    now_.metric = metric_at(now_);
    BranchVector forward{
        .displacement = Eigen::MatrixXd::Zero(now_.at.displacement.rows(), now_.at.displacement.cols()),
        .omega = (to_ > from_ ? 1 : -1) / now_.metric.omega_weight};
    const TangentResult first = tangent(*now_.state.linearisation, forward, now_.metric);
    if (first.status != Status::converged) {
      branch_.status = first.status;
      branch_.points.push_back({.state = std::move(now_.state)});
      return false;
    }
    now_.tangent = unit(first.tangent, now_.metric);
    now_.orientation = now_.state.linearisation->determinant_sign() * (now_.tangent.omega > 0 ? 1 : -1);
    if (!options_.linearise) now_.state.linearisation.reset();
    if (!report(now_, false)) {
      branch_.status = Status::interrupted;
      return false;
    }
    return true;
  }

  // One unit is a change of the contact's vibration by its own size, or the frequency step that counts as much.
  ArcMetric metric_at(const Station& station) {
    const contact::PseudoPenalty& penalty = now_.state.penalty;
    ArcMetric metric;
    metric.displacement_weight.resize(model_->contact_size());
    for (Eigen::Index i = 0; i < model_->nodes(); ++i) {
      metric.displacement_weight(i * model_->directions()) = penalty.normal(i);
      metric.displacement_weight.segment(i * model_->directions() + 1, model_->directions() - 1)
          .setConstant(penalty.tangential(i));
    }
    const Eigen::MatrixXd forces = metric.displacement_weight.asDiagonal() * station.at.displacement;
    // Slip that is small against what the contact forces do is no reason for tiny steps, nor is an antiresonance.
    constexpr double kSlip = 0.1, kFloor = 1e-2;
    const double vibrating = std::max(vibration(forces), kSlip * vibration(station.state.force));
    largest_forces_ = std::max({largest_forces_, vibrating, 1e-6 * forces.norm()});
    largest_output_ = std::max(largest_output_, vibration(station.state.outputs));
    const double size = std::max(vibrating, kFloor * largest_forces_);
    metric.displacement_weight /= size > 0 ? size : 1.0;
    metric.omega_weight = follow_.largest_change / (follow_.largest_frequency_step * std::abs(to_ - from_));
    return metric;
  }

  static BranchVector unit(const BranchVector& direction, const ArcMetric& metric) {
    const double length = metric.length(direction);
    return {.displacement = direction.displacement / length, .omega = direction.omega / length};
  }

  // A converged point at this distance along the tangent, or nothing and the reason in failure_.
  std::optional<Station> advance(double step) {
    const BranchVector predicted = along(now_.at, now_.tangent, step);
    return station(equations_->correct(predicted, now_.tangent, now_.metric, follow_.max_corrections), step);
  }

  std::optional<Station> station(const BranchEquations::Correction& found, double step) {
    branch_.jacobians += found.iterations;
    branch_.evaluations += found.evaluations;
    failure_ = found.status;
    if (found.status != Status::converged) return {};
    // Further away than twice the step it is another branch, or the other side of a loop; very near, it is the way on
    // behind a sharp kink, where contact that was stuck begins to slide.
    const BranchVector way = difference(found.point, now_.at);
    const double reached = now_.metric.length(way);
    failure_ = Status::stalled;
    constexpr double kSidestep = 2, kKink = 0.1;
    if (reached > std::max(kSidestep * step, kKink * follow_.largest_change)) return {};
    BranchEquations::Described point = equations_->describe(found, now_.tangent, now_.metric);
    failure_ = point.state.status;
    if (point.state.status != Status::converged || !point.linear) return {};
    const TangentResult next = tangent(*point.linear, now_.tangent, now_.metric);
    failure_ = next.status;
    if (next.status != Status::converged) return {};
    Station result;
    result.at = found.point;
    result.state = std::move(point.state);
    result.step = reached;
    result.turn_angle = std::acos(std::min(1.0, 1 / now_.metric.length(next.tangent)));
    result.output_change = output_change(now_.state, result.state);
    result.iterations = found.iterations;
    result.metric = metric_at(result);
    result.tangent = unit(next.tangent, result.metric);
    orient(way, point.linear->determinant_sign(), std::cos(result.turn_angle), result);
    return result;
  }

  // Onwards is away from where the branch came from, and sign(d omega / ds) = constant sign(det J) on a branch:
  // together they tell a fold, at which both change, from a chord over one or a kink sharper than a right angle, where
  // the way come misleads, and from a crossing with another branch, where det J does.
  void orient(const BranchVector& way, int determinant, double cosine, Station& next) const {
    const auto flip = [&] {
      next.tangent.displacement *= -1;
      next.tangent.omega *= -1;
    };
    if (next.metric.inner(way, next.tangent) < 0) flip();
    const int here = determinant * (next.tangent.omega > 0 ? 1 : -1);
    next.orientation = here != 0 ? here : now_.orientation;
    next.doubtful = here != 0 && now_.orientation != 0 && here != now_.orientation;
    constexpr double kStraight = 0.9;
    if (!next.doubtful || cosine > kStraight) return;
    flip();
    next.orientation = now_.orientation;
  }

  [[nodiscard]] double output_change(const SteadyState& before, const SteadyState& after) const {
    if (after.outputs.size() == 0) return 0;
    constexpr double kFloor = 1e-2;
    const double size = std::max({vibration(before.outputs), vibration(after.outputs), kFloor * largest_output_});
    return size > 0 ? (after.outputs - before.outputs).norm() / size : 0;
  }

  // How much longer the step could have been before it turned or changed too much.
  [[nodiscard]] double shape_factor(const Station& next) const {
    constexpr double kSmall = 1e-9;
    return std::min(follow_.largest_turn / std::max(next.turn_angle, kSmall),
                    follow_.largest_change / std::max(next.output_change, kSmall));
  }
  [[nodiscard]] bool fine(const Station& next) const {
    constexpr double kTolerated = 1.5;  // a step a little too long is not worth a second one
    return kTolerated * shape_factor(next) >= 1;
  }

  [[nodiscard]] double next_step(const Station& next, double step) const {
    constexpr double kWantedIterations = 4, kGrowth = 2;
    const double by_iterations = std::exp2((kWantedIterations - next.iterations) / 2.0);
    const double factor = std::clamp(std::min(by_iterations, 0.8 * shape_factor(next)), 1 / kGrowth, kGrowth);
    return std::clamp(step * factor, follow_.smallest_step, follow_.largest_change);
  }

  // The end of the interval behind which omega lies, if any.
  [[nodiscard]] std::optional<double> end_passed(double omega) const {
    const double sign = to_ > from_ ? 1 : -1;
    if (sign * (omega - to_) >= 0) return to_;
    if (sign * (omega - from_) <= 0) return from_;
    return {};
  }

  // Puts the last point exactly at the end that lies between now and `beyond`; false when the branch does not go there.
  bool finish_at(double end, const Station& beyond) {
    const double whole = beyond.at.omega - now_.at.omega;
    const double part = whole != 0 ? (end - now_.at.omega) / whole : 0;
    if (part < 0 || part > 1) return false;
    BranchVector start = along(now_.at, difference(beyond.at, now_.at), part);
    start.omega = end;
    const BranchEquations::Correction found = equations_->correct_at(start, follow_.max_corrections);
    std::optional<Station> last = station(found, beyond.step);
    if (!last) return false;
    accept(std::move(*last), false);
    branch_.status = Status::converged;
    return true;
  }

  // Between now and `next` the frequency turned: puts a point on its extreme, by regula falsi on d omega / ds over the
  // length of the step, or bisection where that jumps because a sample changes its contact state. Leaves it out when
  // the corrections fail. False when the caller wants to stop.
  bool place_turn(const Station& next) {
    constexpr int kTries = 10;
    constexpr double kFlat = 1e-6;  // what omega can still change by, in the units of the metric
    double low = 0, high = now_.metric.inner(difference(next.at, now_.at), now_.tangent);
    double slope_low = slope(now_), slope_high = slope(next);
    std::optional<Station> best;
    for (int i = 0; i < kTries; ++i) {
      const double part = i % 2 == 0 ? slope_low / (slope_low - slope_high) : 0.5;
      const double step = low + (high - low) * std::clamp(part, 0.02, 0.98);
      std::optional<Station> middle = advance(step);
      if (!middle) break;
      const double here = slope(*middle);
      if (!best || std::copysign(1.0, slope(now_)) * (middle->at.omega - best->at.omega) > 0) best = std::move(middle);
      const bool before = here * slope(now_) > 0;
      (before ? low : high) = step;
      (before ? slope_low : slope_high) = here;
      if (std::abs(here) * (high - low) <= kFlat) break;
    }
    if (!best) return true;
    const bool go_on = report(*best, true);
    turn_reported_ = true;
    return go_on;
  }
  [[nodiscard]] static double slope(const Station& station) {
    return station.metric.omega_weight * station.tangent.omega;
  }

  bool accept(Station next, bool is_turn) {
    const bool go_on = report(next, is_turn);
    now_ = std::move(next);
    return go_on;
  }

  bool report(const Station& station, bool is_turn) {
    const bool first = branch_.points.empty();
    ContinuationPoint point{.state = station.state, .is_turn = is_turn};
    point.direction = slope(station);
    if (!first) {
      const ContinuationPoint& last = branch_.points.back();
      const bool turned = is_turn || (!turn_reported_ && last.direction * point.direction < 0);
      point.turns = last.turns + (turned ? 1 : 0);
      point.arc_length = last.arc_length + now_.metric.length(difference(station.at, reported_));
    }
    if (!is_turn) turn_reported_ = false;
    reported_ = station.at;
    branch_.points.push_back(std::move(point));
    return !progress_ || progress_(branch_.points.back());
  }

  Branch finish(Status status) {
    branch_.status = status;
    return std::move(branch_);
  }

  const std::shared_ptr<const CondensedModel>& model_;
  const ContactCondition& condition_;
  const SteadyOptions& options_;
  const ContinuationOptions& follow_;
  const std::function<bool(const ContinuationPoint&)>& progress_;
  double from_, to_;
  std::optional<BranchEquations> equations_;
  Station now_;
  BranchVector reported_;
  Branch branch_;
  Status failure_ = Status::stalled;
  double largest_forces_ = 0, largest_output_ = 0;
  bool turn_reported_ = false;
};

}  // namespace

Branch continuation(const std::shared_ptr<const CondensedModel>& model, double omega_from, double omega_to,
                    const ContactCondition& condition, const SteadyOptions& options,
                    const ContinuationOptions& continuation_options,
                    const std::function<bool(const ContinuationPoint&)>& progress, const Eigen::MatrixXd& guess) {
  std::vector<Violation> found = violations(continuation_options);
  for (const auto& [key, omega] : {std::pair{"omega_from", omega_from}, std::pair{"omega_to", omega_to}})
    if (!kPositive.contains(omega) || !std::isfinite(omega))
      found.push_back({.file = {}, .key = key, .value = shortest(omega), .allowed = kPositive.phrase()});
  if (omega_from == omega_to)
    found.push_back(
        {.file = {}, .key = "omega_to", .value = shortest(omega_to), .allowed = "must differ from omega_from"});
  if (!found.empty()) throw InputError(std::move(found));
  validate(options);
  return Follower(model, omega_from, omega_to, condition, options, continuation_options, progress).run(guess);
}

}  // namespace dovetail::response

namespace dovetail {

using response::ContinuationOptions;

template <>
std::span<const Field<ContinuationOptions>> option_table<ContinuationOptions>() {
  static const std::array fields{
      Field<ContinuationOptions>{.key = "largest_frequency_step",
                                 .member = &ContinuationOptions::largest_frequency_step,
                                 .range = {.lower = 0, .upper = 1, .lower_open = true},
                                 .help = "between points, fraction of the interval"},
      Field<ContinuationOptions>{.key = "largest_change",
                                 .member = &ContinuationOptions::largest_change,
                                 .range = kPositive,
                                 .help = "of displacements and outputs between points, relative"},
      Field<ContinuationOptions>{.key = "largest_turn",
                                 .member = &ContinuationOptions::largest_turn,
                                 .range = kPositive,
                                 .help = "of the tangent between points, rad"},
      Field<ContinuationOptions>{.key = "initial_step",
                                 .member = &ContinuationOptions::initial_step,
                                 .range = kPositive,
                                 .help = "first step, arc length"},
      Field<ContinuationOptions>{.key = "smallest_step",
                                 .member = &ContinuationOptions::smallest_step,
                                 .range = kPositive,
                                 .help = "arc length at which the branch is given up"},
      Field<ContinuationOptions>{.key = "max_corrections",
                                 .member = &ContinuationOptions::max_corrections,
                                 .range = {.lower = 2},
                                 .help = "Jacobians per point tried"},
      Field<ContinuationOptions>{.key = "max_points",
                                 .member = &ContinuationOptions::max_points,
                                 .range = {.lower = 2},
                                 .help = "points of the branch at most"},
      Field<ContinuationOptions>{.key = "locate_turns",
                                 .member = &ContinuationOptions::locate_turns,
                                 .help = "put a point on every turning point"},
  };
  return fields;
}

}  // namespace dovetail
