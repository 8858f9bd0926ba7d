#include "paths/peak.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "branches/bordered.hpp"
#include "paths/params.hpp"
#include "paths/stationarity.hpp"
#include "steady/problem.hpp"

namespace dovetail::paths {
namespace {

// A point near the branch with its direction d, the correction c towards the branch and the amplitude along it.
struct Local {
  Status status = Status::singular;
  std::shared_ptr<steady::Point> point = {};
  branches::Vector at, direction, correction;
  double distance = 0;  // |c|
  AmplitudeAt amplitude;
  bool on_branch = false;
};

// The point of the equations there; null where they cannot be set up.
std::shared_ptr<steady::Point> evaluated(const branches::Equations& branch, const branches::Vector& at) {
  const std::shared_ptr<const steady::Problem> problem = branch.at(at.parameter);
  if (!problem) return {};
  auto point = std::make_shared<steady::Point>();
  steady::evaluate(problem, at.displacement, *point);
  return point;
}

Local linearised(const branches::Equations& branch, const branches::Vector& at, std::shared_ptr<steady::Point> point,
                 const branches::Vector& along, const branches::ArcMetric& metric, Eigen::Index output) {
  Local local;
  local.at = at;
  local.point = std::move(point);
  if (!local.point) return local;
  if (spent(branch.options().budget)) {
    local.status = Status::budget_spent;
    return local;
  }
  const double error = local.point->error();
  local.status = Status::not_finite;
  if (!std::isfinite(error)) return local;
  local.on_branch = error <= steady::attainable(*local.point, branch.options().tolerance);
  local.status = Status::singular;
  if (local.on_branch && !steady::is_held(*local.point)) return local;
  steady::differentiate(*local.point);
  const steady::Tangent tangent(local.point);
  const branches::ArcMetric::Row row = metric.row(along);
  const branches::BorderedSystem bordered(tangent, branch.slope(*local.point), row.displacement, row.parameter);
  const branches::BorderedSystem::Solution ahead = bordered.solve(Eigen::VectorXd::Zero(row.displacement.size()), 1);
  const branches::BorderedSystem::Solution back = bordered.solve(-local.point->residual.reshaped(), 0);
  if (ahead.status != Status::converged || back.status != Status::converged) return local;
  local.direction = metric.unit(bordered.vector(ahead));
  local.correction = bordered.vector(back);
  local.distance = metric.length(local.correction);
  local.amplitude = amplitude_at(*local.point, local.direction, output);
  local.status = std::isfinite(local.distance) ? Status::converged : Status::not_finite;
  return local;
}

}  // namespace

branches::ArcMetric peak_metric(const steady::State& state, double width) {
  return branches::arc_metric(state, branches::vibrating_force(state), width);
}

namespace {

class PeakNewton {
 public:
  PeakNewton(const branches::Equations& branch, const branches::ArcMetric& metric, const PeakOptions& options)
      : branch_(branch), metric_(metric), options_(options), stationarity_(kParams.linear, kParams.trust) {}

  Peak run(const branches::Vector& start) {
    peak_.at = start_ = start;
    const branches::Vector forward = reference_ = metric_.forwards(start.displacement);
    if (!look(start, forward, kParams.near) && !correct(start, forward)) return peak_;
    while (peak_.iterations < options_.max_iterations) {
      if (!clean()) {
        if (!go_back()) return peak_;
        continue;
      }
      if (observe()) return peak_;
      if (!move()) return peak_;
    }
    peak_.status = Status::iteration_limit;
    return peak_;
  }

 private:
  static constexpr PeakParams kParams = {};

  struct Visited {
    Local local;
    double place = 0;
  };

  // Linearises at a point; false when that fails or the branch is further away than `nearest`.
  bool look(const branches::Vector& at, const branches::Vector& along, double nearest) {
    ++peak_.evaluations;
    return look(at, evaluated(branch_, at), along, nearest);
  }
  bool look(const branches::Vector& at, std::shared_ptr<steady::Point> point, const branches::Vector& along,
            double nearest) {
    Local found = linearised(branch_, at, std::move(point), along, metric_, options_.output);
    ++peak_.iterations;
    peak_.status = found.status;
    if (found.status != Status::converged || !(found.on_branch || found.distance <= nearest)) return false;
    here_ = std::move(found);
    return true;
  }

  // The point of the branch in the plane through `from` across `row`; false when the corrector fails.
  bool correct(const branches::Vector& from, const branches::Vector& row) {
    branches::Equations::Correction found = branch_.correct(from, row, metric_, kParams.corrections);
    peak_.iterations += found.iterations;
    peak_.evaluations += found.evaluations;
    peak_.status = found.status;
    if (found.status != Status::converged) return false;
    // Another branch is no place to look for this peak.
    peak_.status = Status::stalled;
    if (metric_.length(found.at - from) > kParams.away) return false;
    return look(found.at, std::make_shared<steady::Point>(std::move(found.point)), row, kParams.near);
  }

  [[nodiscard]] double slope() const {
    return here_.amplitude.value > 0 ? here_.amplitude.change / here_.amplitude.value : 0;
  }
  [[nodiscard]] double place() const { return metric_.inner(here_.at - start_, reference_); }

  // A slope is as wrong as its point is away from the branch: before it says where to go, the point goes back.
  [[nodiscard]] bool clean() const { return here_.on_branch || here_.distance <= kParams.clean * std::abs(slope()); }
  bool go_back() {
    const Local from = here_;
    return look(from.at + from.correction, from.direction, 0.5 * from.distance) || correct(from.at, from.direction);
  }

  // Takes the slope of a clean point into account; true at the maximum.
  bool observe() {
    if (!referred_) reference_ = here_.direction;
    referred_ = true;
    stationarity_.add({.place = place(),
                       .omega = here_.at.parameter,
                       .amplitude = here_.amplitude.value,
                       .slope = slope(),
                       .off = here_.on_branch ? 0 : here_.distance});
    const double speed = std::abs(here_.direction.parameter);
    const double tolerated = options_.frequency_tolerance * here_.at.parameter;
    // Along a steep branch the frequency hardly moves: the place on the branch must be known as well.
    const double near = tolerated > kParams.flat * speed ? kParams.flat : tolerated / speed;
    step_ = stationarity_.step(near);
    peak_.at = here_.at;
    peak_.point = here_.point;
    peak_.amplitude = here_.amplitude.value;
    peak_.slope = slope();
    peak_.width = here_.amplitude.speed > 0 ? speed / here_.amplitude.speed : 1 / metric_.parameter_weight;
    peak_.error = stationarity_.error() * speed / here_.at.parameter;
    peak_.status = Status::converged;
    return here_.on_branch && stationarity_.settled(near);
  }

  // To the next place, from the point known best for it.
  bool move() {
    const double target = place() + step_;
    ends_.push_back({here_, place()});
    std::erase_if(
        ends_, [&](const Visited& end) { return !stationarity_.is_end(end.place) && end.place != ends_.back().place; });
    Visited from = ends_.back();
    if (std::abs(step_) > kParams.short_step)
      for (const Visited& end : ends_)
        if (worth(end, target) > worth(from, target)) from = end;
    // Where the branch turns away from the reference a step along it gains little place.
    const double gain = metric_.inner(from.local.direction, reference_);
    peak_.status = Status::stalled;
    if (gain < kParams.turned) return false;
    double step = (target - from.place) / gain;
    if (std::abs(step) <= kParams.short_step && from.local.distance <= kParams.near &&
        look(from.local.at + from.local.correction + step * from.local.direction, from.local.direction,
             kParams.near / 2))
      return true;
    for (int i = 0; i < kParams.shortenings && peak_.iterations < options_.max_iterations;
         ++i, step *= kParams.shortening)
      if (correct(from.local.at + step * from.local.direction, from.local.direction)) return true;
    return false;
  }

  // Amplitude of a point less what is lost over the way to `target` if it fell as at a linear peak.
  [[nodiscard]] static double worth(const Visited& from, double target) {
    return std::log(from.local.amplitude.value) - 2 * std::abs(target - from.place);
  }

  const branches::Equations& branch_;
  const branches::ArcMetric& metric_;
  const PeakOptions& options_;
  Stationarity stationarity_;
  branches::Vector start_, reference_;
  bool referred_ = false;
  Local here_;
  std::vector<Visited> ends_;
  double step_ = 0;
  Peak peak_;
};

}  // namespace

Peak find_peak(const branches::Equations& branch, const branches::Vector& start, const branches::ArcMetric& metric,
               const PeakOptions& options) {
  return PeakNewton(branch, metric, options).run(start);
}

steady::State described(const branches::Equations& branch, const Peak& peak, const branches::ArcMetric& metric) {
  const branches::Equations::Correction found{.status = Status::converged,
                                              .at = peak.at,
                                              .point = *peak.point,
                                              .iterations = peak.iterations,
                                              .evaluations = peak.evaluations};
  return branch.describe(found, metric.forwards(peak.at.displacement), metric).state;
}

}  // namespace dovetail::paths
