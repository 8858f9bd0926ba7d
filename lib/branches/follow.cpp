#include "branches/follow.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "branches/params.hpp"
#include "branches/station.hpp"
#include "branches/turns.hpp"

namespace dovetail::branches {
namespace {

class Follower {
 public:
  Follower(const Equations& equations, const Interval& interval, const FollowOptions& follow,
           const std::function<bool(const BranchPoint&)>& progress)
      : equations_(equations),
        interval_(interval),
        follow_(follow),
        progress_(progress),
        short_(kParams.short_step * follow.largest_change),
        maker_(equations, follow, interval.size()),
        turns_(std::max(follow.smallest_turn, 2.0 / equations.options().samples) * interval.size(), interval.sign()) {}

  Branch run(steady::State start) {
    if (begin(std::move(start))) branch_.status = follow();
    branch_.jacobians += maker_.jacobians();
    branch_.evaluations += maker_.evaluations();
    return std::move(branch_);
  }

 private:
  bool begin(steady::State state) {
    branch_.jacobians = state.iterations;
    branch_.evaluations = state.evaluations;
    branch_.penalty_ratio = state.penalty_ratio;
    branch_.status = state.status;
    std::optional<Station> first;
    if (state.status == Status::converged) {
      first = maker_.first(state, interval_.from, interval_.sign());
      if (!first) branch_.status = maker_.failure();
    }
    if (!first) {
      branch_.points.push_back({.state = std::move(state), .parameter = interval_.from});
      return false;
    }
    now_ = std::move(*first);
    chord_ = now_.tangent;
    note(now_);
    branch_.status = Status::interrupted;
    return report(now_);
  }

  Status follow() {
    double step = std::min(follow_.initial_step, follow_.largest_change);
    while (static_cast<int>(branch_.points.size()) < follow_.max_points) {
      if (spent(equations_.options().budget)) return Status::budget_spent;
      if (follow_.max_jacobians > 0 && maker_.jacobians() >= follow_.max_jacobians) return Status::iteration_limit;
      std::optional<Station> next = attempt(step);
      if (next) {
        if (const std::optional<double> end = end_passed(next->at.parameter)) {
          if (finish_at(*end, *next)) return Status::converged;
          shorter_ = kParams.failed_cut;
          next.reset();
        }
      }
      if (!next) {
        ++branch_.rejected;
        step *= shorter_;
        if (step < follow_.smallest_step)
          return maker_.failure() == Status::converged ? Status::stalled : maker_.failure();
        continue;
      }
      if (follow_.locate_turns && next->slope() * now_.slope() < 0 && !place_turn(*next)) return Status::interrupted;
      step = next_step(*next, step);
      if (!accept(std::move(*next))) return Status::interrupted;
    }
    return Status::iteration_limit;
  }

  // The next station, or nothing and in shorter_ by how much to shorten the step.
  std::optional<Station> attempt(double step) {
    shorter_ = kParams.failed_cut;
    std::optional<Station> next;
    if (since_place_ >= kParams.zigzag) {
      since_place_ = 0;
      next = leap();
      if (next) return next;
    }
    next = maker_.advance(now_, now_.tangent, step);
    if (next && acceptable(*next, step)) return next;
    if (next && !next->doubtful)
      shorter_ = std::clamp(kParams.safety * shape_factor(*next), kParams.shortest_cut, kParams.longest_cut);
    if (next && !next->doubtful) return {};
    // Short of a kink: the way on is the piece behind it, which the plane across this tangent need not meet.
    const std::optional<Vector> ahead = maker_.tangent_ahead(now_, now_.tangent, step);
    if (ahead && now_.metric.inner(*ahead, now_.tangent) < kParams.bent) {
      next = maker_.advance(now_, *ahead, step);
      if (next && acceptable(*next, step)) return next;
    }
    if (step > short_) return {};
    if (now_.metric.inner(chord_, now_.tangent) < kParams.bent * now_.metric.length(chord_)) {
      next = maker_.advance(now_, now_.metric.unit(chord_), step);
      if (next && acceptable(*next, step)) return next;
    }
    return step < kParams.crossing * short_ ? leap() : std::optional<Station>{};
  }

  // Over folds that are smaller than the steps wanted: onwards the way the branch went on the whole, whatever the
  // tangents are there, to beyond everything reached.
  std::optional<Station> leap() {
    const ArcMetric& metric = now_.metric;
    const Vector& last = places_.back();
    if (places_.size() < 2) return {};
    const Vector onwards = metric.unit(last - places_.front());
    for (const double length : kParams.leaps) {
      std::optional<Station> next = maker_.advance(now_, onwards, length * follow_.largest_change);
      if (!next || next->doubtful) continue;
      const double gained = metric.inner(next->at - last, onwards);
      if (gained > kParams.place * follow_.largest_change / 2 && metric.inner(next->tangent, onwards) > 0 &&
          metric.inner(next->at - now_.at, onwards) > kParams.onwards * next->step)
        return next;
    }
    return {};
  }

  // Notes where the branch has been, some way apart; many points without a new place are a zigzag.
  void note(const Station& station) {
    ++since_place_;
    for (const Vector& place : places_)
      if (station.metric.length(station.at - place) < kParams.place * follow_.largest_change) return;
    since_place_ = 0;
    places_.push_back(station.at);
    if (places_.size() > kParams.places) places_.erase(places_.begin());
  }

  [[nodiscard]] bool acceptable(const Station& next, double step) const {
    if (next.doubtful) return step <= kParams.crossing * short_;
    return step <= short_ || fine(next);
  }

  // How much longer the step could have been before it turned or changed too much.
  [[nodiscard]] double shape_factor(const Station& next) const {
    constexpr double kSmall = 1e-9;
    return std::min(follow_.largest_turn / std::max(next.turn_angle, kSmall),
                    follow_.largest_change / std::max(next.output_change, kSmall));
  }
  [[nodiscard]] bool fine(const Station& next) const { return kParams.tolerated * shape_factor(next) >= 1; }

  [[nodiscard]] double next_step(const Station& next, double step) const {
    const double by_iterations = std::exp2((kParams.wanted_corrections - next.iterations) / 2.0);
    const double factor =
        std::clamp(std::min(by_iterations, kParams.safety * shape_factor(next)), 1 / kParams.growth, kParams.growth);
    // Outputs and turns limit the step already. What is left are the parameter, and the contact: its static part may
    // creep by many times its vibration while nothing else changes.
    const double longest = follow_.largest_change / std::max(std::abs(next.slope()), 1 / kParams.creep);
    return std::clamp(std::max(step, next.step / kParams.growth) * factor, follow_.smallest_step, longest);
  }

  // The end of the interval behind which a parameter lies, if any.
  [[nodiscard]] std::optional<double> end_passed(double parameter) const {
    if (interval_.sign() * (parameter - interval_.to) >= 0) return interval_.to;
    if (interval_.sign() * (parameter - interval_.back) <= 0) return interval_.back;
    return {};
  }

  // Puts the last point exactly at the end that lies between now and `beyond`; false when the branch does not go there.
  bool finish_at(double end, const Station& beyond) {
    const double whole = beyond.at.parameter - now_.at.parameter;
    const double part = whole != 0 ? (end - now_.at.parameter) / whole : 0;
    if (part < 0 || part > 1) return false;
    Vector start = now_.at + part * (beyond.at - now_.at);
    start.parameter = end;
    std::optional<Station> last = maker_.at_parameter(now_, start, beyond.step);
    if (!last) return false;
    accept(std::move(*last));
    return true;
  }

  // Between now and `next` the parameter turned: puts a point on its extreme, by regula falsi on its slope over the
  // length of the step, or bisection where that jumps because a sample changes its contact state. Leaves it out when
  // the corrections fail. False when the caller wants to stop.
  bool place_turn(const Station& next) {
    const Vector direction = now_.metric.unit(next.at - now_.at);
    double low = 0, high = now_.metric.length(next.at - now_.at);
    double slope_low = now_.slope(), slope_high = next.slope();
    std::optional<Station> best;
    for (int i = 0; i < kParams.turn_tries; ++i) {
      const double part = i % 2 == 0 ? slope_low / (slope_low - slope_high) : 0.5;
      const double step = low + (high - low) * std::clamp(part, kParams.turn_margin, 1 - kParams.turn_margin);
      std::optional<Station> middle = maker_.advance(now_, direction, step);
      if (!middle) break;
      const double here = middle->slope();
      if (!best || std::copysign(1.0, now_.slope()) * (middle->at.parameter - best->at.parameter) > 0)
        best = std::move(middle);
      const bool before = here * now_.slope() > 0;
      (before ? low : high) = step;
      (before ? slope_low : slope_high) = here;
      if (std::abs(here) * (high - low) <= kParams.turn_flat) break;
    }
    return !best || report(*best);
  }

  bool accept(Station next) {
    const bool go_on = report(next);
    // The chord over the last few points is where the branch goes on the whole.
    const Vector way = next.at - now_.at;
    chord_ = way + kParams.memory * chord_;
    now_ = std::move(next);
    note(now_);
    return go_on;
  }

  bool report(const Station& station) {
    BranchPoint point{.state = station.state, .parameter = station.at.parameter};
    point.direction = station.slope();
    if (!branch_.points.empty())
      point.arc_length = branch_.points.back().arc_length + now_.metric.length(station.at - reported_);
    reported_ = station.at;
    branch_.points.push_back(std::move(point));
    turns_.observe(branch_.points);
    return !progress_ || progress_(branch_.points.back());
  }

  static constexpr FollowParams kParams = {};
  const Equations& equations_;
  const Interval& interval_;
  const FollowOptions& follow_;
  const std::function<bool(const BranchPoint&)>& progress_;
  double short_, shorter_ = 1;
  std::vector<Vector> places_;
  int since_place_ = 0;
  StationMaker maker_;
  Station now_;
  Vector chord_, reported_;
  TurnCounter turns_;
  Branch branch_;
};

}  // namespace

Branch follow(const Equations& equations, steady::State start, const Interval& interval, const FollowOptions& options,
              const std::function<bool(const BranchPoint&)>& progress) {
  if (std::vector<Violation> found = violations(options); !found.empty()) throw InputError(std::move(found));
  return Follower(equations, interval, options, progress).run(std::move(start));
}

}  // namespace dovetail::branches
