#include "response/peak.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "response/amplitude.hpp"
#include "response/bordered.hpp"
#include "response/problem.hpp"
#include "response/real_block.hpp"
#include "response/stationarity.hpp"

namespace dovetail::response {
namespace {

double vibration(const Eigen::MatrixXd& coefficients) {
  return coefficients.rightCols(coefficients.cols() - 1).norm();
}

// A point near the branch with its tangent d, the correction c towards the branch and the amplitude along it.
struct Local {
  Status status = Status::singular;
  std::shared_ptr<const SteadyResidual> residual = {};
  BranchVector point, direction, correction;
  double distance = 0;  // |c|
  AmplitudeAt amplitude;
  bool on_branch = false;
};

BranchVector moved(const BranchVector& from, const BranchVector& direction, double step) {
  return {.displacement = from.displacement + step * direction.displacement,
          .omega = from.omega + step * direction.omega};
}

Local linearised(const BranchEquations& branch, const BranchVector& point, const BranchVector& along,
                 const ArcMetric& metric, Eigen::Index output) {
  Local local;
  local.point = point;
  if (spent(branch.options().budget)) {
    local.status = Status::budget_spent;
    return local;
  }
  local.residual = branch.at(point.omega);
  if (!local.residual) return local;
  ResidualState state;
  local.residual->evaluate(point.displacement, true, state);
  const double error = local.residual->relative_norm(state.residual);
  local.status = Status::not_finite;
  if (!std::isfinite(error)) return local;
  const double floor = std::min(rounding_floor(*local.residual, state), kLargestFloor);
  local.on_branch = error <= std::max(branch.options().tolerance, floor);
  local.status = Status::singular;
  if (local.on_branch && !is_held(*local.residual, state)) return local;
  const Eigen::VectorXd forces = state.residual.reshaped();
  const Linearisation linear(*local.residual, std::move(state));
  const Eigen::MatrixXd row = metric.displacement_weight.cwiseAbs2().asDiagonal() * along.displacement;
  const BorderedSystem bordered(linear, row.reshaped(), metric.omega_weight * metric.omega_weight * along.omega);
  const BorderedSystem::Solution ahead = bordered.solve(Eigen::VectorXd::Zero(row.size()), 1);
  const BorderedSystem::Solution back = bordered.solve(-forces, 0);
  if (ahead.status != Status::converged || back.status != Status::converged) return local;
  const auto vector = [&](const BorderedSystem::Solution& solution) {
    return BranchVector{.displacement = solution.displacement.reshaped(row.rows(), row.cols()),
                        .omega = solution.omega};
  };
  local.direction = vector(ahead);
  const double length = metric.length(local.direction);
  local.direction.displacement /= length;
  local.direction.omega /= length;
  local.correction = vector(back);
  local.distance = metric.length(local.correction);
  local.amplitude = amplitude_at(*local.residual, point, local.direction, output);
  local.status = std::isfinite(local.distance) ? Status::converged : Status::not_finite;
  return local;
}

}  // namespace

AmplitudeAt amplitude_at(const SteadyResidual& residual, const BranchVector& point, const BranchVector& direction,
                         Eigen::Index output) {
  const CondensedModel& model = residual.model();
  const Eigen::Index k = point.displacement.cols();
  Eigen::MatrixXd value(1, k), change(1, k);
  for (std::size_t h = 0; h < residual.system().harmonics.size(); ++h) {
    const HarmonicStiffness& at = residual.system().harmonics[h];
    const auto j = static_cast<Eigen::Index>(h);
    const Eigen::VectorXcd contact = harmonic_of(point.displacement, j);
    const Eigen::VectorXcd moved = model.output_gradient(at) * harmonic_of(direction.displacement, j) +
                                   direction.omega * model.output_slope(static_cast<int>(h), point.omega, at, contact);
    put_harmonic(model.outputs(at, contact).segment(output, 1), j, value);
    put_harmonic(moved.segment(output, 1), j, change);
  }
  const Extremes ends = extremes(value.row(0).transpose());
  // The extremes are stationary in time: only the coefficients move them, to first order.
  const Eigen::VectorXd difference = fourier_row(ends.tau_maximum, k) - fourier_row(ends.tau_minimum, k);
  const double size = vibration(value);
  return {.value = ends.amplitude(),
          .change = change.row(0).dot(difference) / 2,
          .speed = size > 0 ? vibration(change) / size : 0};
}

double peak_width(const SteadyState& state, Eigen::Index output) {
  const BranchVector point{.displacement = state.displacement, .omega = state.omega};
  const BranchVector along{.displacement = state.linearisation->response_to_frequency(), .omega = 1};
  const double speed = amplitude_at(state.linearisation->residual(), point, along, output).speed;
  // A resonance sharper than this is not resolved by the frequency tolerance either.
  constexpr double kSharpest = 1e-6, kWidest = 0.5;
  return state.omega * std::clamp(speed > 0 ? 1 / (speed * state.omega) : kWidest, kSharpest, kWidest);
}

ArcMetric peak_metric(const SteadyState& state, double width) {
  const Eigen::Index d = state.displacement.rows() / std::max<Eigen::Index>(state.penalty.normal.size(), 1);
  ArcMetric metric;
  metric.displacement_weight.resize(state.displacement.rows());
  for (Eigen::Index i = 0; i < state.penalty.normal.size(); ++i) {
    metric.displacement_weight(i * d) = state.penalty.normal(i);
    metric.displacement_weight.segment(i * d + 1, d - 1).setConstant(state.penalty.tangential(i));
  }
  // Contact that is almost stuck does not say how large the vibration is, its forces do.
  constexpr double kSlip = 0.1;
  const Eigen::MatrixXd forces = metric.displacement_weight.asDiagonal() * state.displacement;
  const double size = std::max(vibration(forces), kSlip * vibration(state.force));
  metric.displacement_weight /= size > 0 ? size : 1.0;
  metric.omega_weight = 1 / width;
  return metric;
}

namespace {

class PeakNewton {
 public:
  PeakNewton(const BranchEquations& branch, const ArcMetric& metric, const PeakOptions& options, double curvature)
      : branch_(branch), metric_(metric), options_(options), stationarity_(curvature) {}

  Peak run(const BranchVector& start) {
    peak_.point = start_ = start;
    const BranchVector forward{
        .displacement = Eigen::MatrixXd::Zero(start.displacement.rows(), start.displacement.cols()),
        .omega = 1 / metric_.omega_weight};
    reference_ = forward;
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
  bool look(const BranchVector& point, const BranchVector& along, double nearest) {
    Local found = linearised(branch_, point, along, metric_, options_.output);
    ++peak_.iterations;
    ++peak_.evaluations;
    peak_.status = found.status;
    if (found.status != Status::converged || !(found.on_branch || found.distance <= nearest)) return false;
    here_ = std::move(found);
    return true;
  }

  // The point of the branch in the plane through `from` across `row`; false when the corrector fails.
  bool correct(const BranchVector& from, const BranchVector& row) {
    constexpr int kCorrections = 8;
    const BranchEquations::Correction found = branch_.correct(from, row, metric_, kCorrections);
    peak_.iterations += found.iterations;
    peak_.evaluations += found.evaluations;
    peak_.status = found.status;
    if (found.status != Status::converged) return false;
    // Another branch is no place to look for this peak.
    constexpr double kAway = 2;
    peak_.status = Status::stalled;
    if (metric_.length(moved(found.point, from, -1)) > kAway) return false;
    return look(found.point, row, kNear);
  }

  [[nodiscard]] double slope() const {
    return here_.amplitude.value > 0 ? here_.amplitude.change / here_.amplitude.value : 0;
  }
  [[nodiscard]] double place() const { return metric_.inner(moved(here_.point, start_, -1), reference_); }

  // A slope is as wrong as its point is away from the branch: before it says where to go, the point goes back.
  [[nodiscard]] bool clean() const {
    constexpr double kClean = 0.1;
    return here_.on_branch || here_.distance <= kClean * std::abs(slope());
  }
  bool go_back() {
    const Local from = here_;
    return look(moved(from.point, from.correction, 1), from.direction, 0.5 * from.distance) ||
           correct(from.point, from.direction);
  }

  // Takes the slope of a clean point into account; true at the maximum.
  bool observe() {
    if (!referred_) reference_ = here_.direction;
    referred_ = true;
    stationarity_.add(
        {.place = place(), .omega = here_.point.omega, .amplitude = here_.amplitude.value, .slope = slope()});
    step_ = stationarity_.step();
    peak_.point = here_.point;
    peak_.residual = here_.residual;
    peak_.amplitude = here_.amplitude.value;
    peak_.slope = slope();
    peak_.curvature = stationarity_.curvature();
    peak_.width =
        here_.amplitude.speed > 0 ? std::abs(here_.direction.omega) / here_.amplitude.speed : 1 / metric_.omega_weight;
    const double way = std::abs(step_ * here_.direction.omega);
    const double tolerated = options_.frequency_tolerance * here_.point.omega;
    peak_.error = std::min(way, stationarity_.bracket()) / here_.point.omega;
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
        look(moved(moved(from.local.point, from.local.correction, 1), from.local.direction, step), from.local.direction,
             kNear / 2))
      return true;
    constexpr int kShortenings = 4;
    for (int i = 0; i < kShortenings && peak_.iterations < options_.max_iterations; ++i, step *= 0.3)
      if (correct(moved(from.local.point, from.local.direction, step), from.local.direction)) return true;
    return false;
  }

  // Amplitude of a point less what is lost over the way to `target` if it fell as at a linear peak.
  [[nodiscard]] static double worth(const Visited& from, double target) {
    return std::log(from.local.amplitude.value) - 2 * std::abs(target - from.place);
  }

  const BranchEquations& branch_;
  const ArcMetric& metric_;
  const PeakOptions& options_;
  Stationarity stationarity_;
  BranchVector start_, reference_;
  bool referred_ = false;
  Local here_;
  std::vector<Visited> ends_;
  double step_ = 0;
  Peak peak_;
};

}  // namespace

Peak find_peak(const BranchEquations& branch, const BranchVector& start, const ArcMetric& metric,
               const PeakOptions& options, double curvature) {
  return PeakNewton(branch, metric, options, curvature).run(start);
}

}  // namespace dovetail::response
