#include "paths/peak.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "branches/bordered.hpp"
#include "dynamics/extremes.hpp"
#include "dynamics/real_block.hpp"
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

Local linearised(const branches::Equations& branch, const branches::Vector& at, const branches::Vector& along,
                 const branches::ArcMetric& metric, Eigen::Index output) {
  Local local;
  local.at = at;
  if (spent(branch.options().budget)) {
    local.status = Status::budget_spent;
    return local;
  }
  const std::shared_ptr<const steady::Problem> problem = branch.at(at.parameter);
  if (!problem) return local;
  local.point = std::make_shared<steady::Point>();
  steady::evaluate(problem, at.displacement, *local.point);
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

AmplitudeAt amplitude_at(const steady::Point& point, const branches::Vector& direction, Eigen::Index output) {
  const steady::Problem& problem = *point.problem;
  const dynamics::CondensedModel& model = problem.model();
  const Eigen::Index k = point.displacement.cols();
  Eigen::MatrixXd value(1, k), change(1, k);
  for (std::size_t h = 0; h < problem.system().harmonics.size(); ++h) {
    const dynamics::HarmonicStiffness& at = problem.system().harmonics[h];
    const auto j = static_cast<Eigen::Index>(h);
    const Eigen::VectorXcd contact = dynamics::harmonic_of(point.displacement, j);
    const Eigen::VectorXcd moved =
        model.output_gradient(at) * dynamics::harmonic_of(direction.displacement, j) +
        direction.parameter * model.output_slope(static_cast<int>(h), problem.system().omega, at, contact);
    dynamics::put_harmonic(model.outputs(at, contact).segment(output, 1), j, value);
    dynamics::put_harmonic(moved.segment(output, 1), j, change);
  }
  const dynamics::Extremes ends = dynamics::extremes(value.row(0).transpose());
  // The extremes are stationary in time: only the coefficients move them, to first order.
  const Eigen::VectorXd difference =
      dynamics::fourier_row(ends.tau_maximum, k) - dynamics::fourier_row(ends.tau_minimum, k);
  const double size = branches::vibration(value);
  return {.value = ends.amplitude(),
          .change = change.row(0).dot(difference) / 2,
          .speed = size > 0 ? branches::vibration(change) / size : 0};
}

double peak_width(const steady::State& state, Eigen::Index output) {
  const branches::Vector along{.displacement = state.tangent->response_to_frequency(), .parameter = 1};
  const double speed = amplitude_at(state.tangent->point(), along, output).speed;
  // A resonance sharper than this is not resolved by the frequency tolerance either.
  constexpr double kSharpest = 1e-6, kWidest = 0.5;
  return state.omega * std::clamp(speed > 0 ? 1 / (speed * state.omega) : kWidest, kSharpest, kWidest);
}

branches::ArcMetric peak_metric(const steady::State& state, double width) {
  return branches::arc_metric(state, branches::vibrating_force(state), width);
}

namespace {

class PeakNewton {
 public:
  PeakNewton(const branches::Equations& branch, const branches::ArcMetric& metric, const PeakOptions& options,
             double curvature)
      : branch_(branch), metric_(metric), options_(options), stationarity_(curvature) {}

  Peak run(const branches::Vector& start) {
    peak_.at = start_ = start;
    const branches::Vector forward = reference_ = metric_.forwards(start.displacement);
    if (!look(start, forward, kNear) && !correct(start, forward)) return peak_;
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
  // Within this distance of the branch Newton acts on the point and on its place at once; from further away, and over
  // longer steps, the point is first brought back by the corrector with its line search.
  static constexpr double kNear = 0.2, kShort = 0.1;

  struct Visited {
    Local local;
    double place = 0;
  };

  // Linearises at a point; false when that fails or the branch is further away than `nearest`.
  bool look(const branches::Vector& point, const branches::Vector& along, double nearest) {
    Local found = linearised(branch_, point, along, metric_, options_.output);
    ++peak_.iterations;
    ++peak_.evaluations;
    peak_.status = found.status;
    if (found.status != Status::converged || !(found.on_branch || found.distance <= nearest)) return false;
    here_ = std::move(found);
    return true;
  }

  // The point of the branch in the plane through `from` across `row`; false when the corrector fails.
  bool correct(const branches::Vector& from, const branches::Vector& row) {
    constexpr int kCorrections = 8;
    const branches::Equations::Correction found = branch_.correct(from, row, metric_, kCorrections);
    peak_.iterations += found.iterations;
    peak_.evaluations += found.evaluations;
    peak_.status = found.status;
    if (found.status != Status::converged) return false;
    // Another branch is no place to look for this peak.
    constexpr double kAway = 2;
    peak_.status = Status::stalled;
    if (metric_.length(found.at - from) > kAway) return false;
    return look(found.at, row, kNear);
  }

  [[nodiscard]] double slope() const {
    return here_.amplitude.value > 0 ? here_.amplitude.change / here_.amplitude.value : 0;
  }
  [[nodiscard]] double place() const { return metric_.inner(here_.at - start_, reference_); }

  // A slope is as wrong as its point is away from the branch: before it says where to go, the point goes back.
  [[nodiscard]] bool clean() const {
    constexpr double kClean = 0.1;
    return here_.on_branch || here_.distance <= kClean * std::abs(slope());
  }
  bool go_back() {
    const Local from = here_;
    return look(from.at + from.correction, from.direction, 0.5 * from.distance) || correct(from.at, from.direction);
  }

  // Takes the slope of a clean point into account; true at the maximum.
  bool observe() {
    if (!referred_) reference_ = here_.direction;
    referred_ = true;
    stationarity_.add(
        {.place = place(), .omega = here_.at.parameter, .amplitude = here_.amplitude.value, .slope = slope()});
    step_ = stationarity_.step();
    peak_.at = here_.at;
    peak_.point = here_.point;
    peak_.amplitude = here_.amplitude.value;
    peak_.slope = slope();
    peak_.curvature = stationarity_.curvature();
    peak_.width = here_.amplitude.speed > 0 ? std::abs(here_.direction.parameter) / here_.amplitude.speed
                                            : 1 / metric_.parameter_weight;
    const double way = std::abs(step_ * here_.direction.parameter);
    const double tolerated = options_.frequency_tolerance * here_.at.parameter;
    peak_.error = std::min(way, stationarity_.bracket()) / here_.at.parameter;
    // Along a steep branch the frequency hardly moves: the place on the branch must be known as well.
    constexpr double kFlat = 1e-4, kPart = 0.2;
    const bool stands = way <= kPart * tolerated || stationarity_.bracket() <= tolerated;
    peak_.status = Status::converged;
    return here_.on_branch && std::abs(step_) <= kFlat && stands;
  }

  // To the next place, from the point known best for it.
  bool move() {
    const double target = place() + step_;
    ends_.push_back({here_, place()});
    std::erase_if(
        ends_, [&](const Visited& end) { return !stationarity_.is_end(end.place) && end.place != ends_.back().place; });
    Visited from = ends_.back();
    if (std::abs(step_) > kShort)
      for (const Visited& end : ends_)
        if (worth(end, target) > worth(from, target)) from = end;
    // Where the branch turns away from the reference a step along it gains little place.
    constexpr double kTurned = 0.2;
    const double gain = metric_.inner(from.local.direction, reference_);
    peak_.status = Status::stalled;
    if (gain < kTurned) return false;
    double step = (target - from.place) / gain;
    if (std::abs(step) <= kShort && from.local.distance <= kNear &&
        look(from.local.at + from.local.correction + step * from.local.direction, from.local.direction, kNear / 2))
      return true;
    constexpr int kShortenings = 4;
    for (int i = 0; i < kShortenings && peak_.iterations < options_.max_iterations; ++i, step *= 0.3)
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
               const PeakOptions& options, double curvature) {
  return PeakNewton(branch, metric, options, curvature).run(start);
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
