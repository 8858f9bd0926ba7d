#include "paths/resonance.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <optional>

#include "dynamics/extremes.hpp"
#include "dynamics/real_block.hpp"
#include "paths/peak.hpp"
#include "paths/peak_sweep.hpp"

namespace dovetail::paths {
namespace {

// Fourier coefficients of one output and their total derivative with respect to omega.
struct OutputSlope {
  Eigen::VectorXd value, slope;
};

OutputSlope output_slope(const steady::State& state, Eigen::Index output) {
  const steady::Problem& problem = state.tangent->problem();
  const Eigen::MatrixXd response = state.tangent->response_to_frequency();
  Eigen::MatrixXd slope = Eigen::MatrixXd::Zero(state.outputs.rows(), state.outputs.cols());
  for (std::size_t h = 0; h < problem.system().harmonics.size(); ++h) {
    const dynamics::HarmonicStiffness& at = problem.system().harmonics[h];
    const auto j = static_cast<Eigen::Index>(h);
    const Eigen::VectorXcd change = problem.model().output_gradient(at) * dynamics::harmonic_of(response, j) +
                                    problem.model().output_slope(static_cast<int>(h), state.omega, at,
                                                                 dynamics::harmonic_of(state.displacement, j));
    dynamics::put_harmonic(change, j, slope);
  }
  return {.value = state.outputs.row(output).transpose(), .slope = slope.row(output).transpose()};
}

// A point of the response curve near its peak.
struct Point {
  double omega = 0, amplitude = 0, slope = 0;
  std::complex<double> pole;  // of the one-mode model 1/Y = (pole - omega)/R through this point
  steady::State state;
};

class PeakSearch {
 public:
  PeakSearch(const steady::Joint& joint, const ResonanceOptions& peak) : joint_(joint), peak_(peak) {
    joint_.options.linearise = true;
  }

  // The response at omega, continued from the last point; halves the way when that does not converge. Where Newton's
  // method alone does not get there soon, half the way costs less than its rescues, and they may end on another branch:
  // these come last.
  bool go(double omega) {
    constexpr int kCautious = 3, kHalvings = 8;
    const double wanted = omega;
    const bool continued = joint_.options.solver == "auto" && now_.state.tangent;
    for (int halving = 0; halving < kHalvings && result_.solves < peak_.max_solves; ++halving) {
      if (continued && halving == kCautious) omega = wanted;
      steady::Joint joint = joint_;
      if (continued && halving < kCautious) {
        joint.options.solver = "newton";
        joint.options.max_iterations = std::min(kHard, joint_.options.max_iterations);
        joint.options.penalty_cascade = false;
        joint.options.max_rescue_iterations = 0;
      }
      Eigen::MatrixXd guess = guess_;
      if (now_.state.tangent)
        guess = now_.state.displacement + (omega - now_.omega) * now_.state.tangent->response_to_frequency();
      steady::State state = steady_state(joint, omega, guess, now_.state.tangent);
      ++result_.solves;
      result_.jacobians += state.iterations;
      last_status_ = state.status;
      if (last_status_ == Status::converged) {
        accept(std::move(state));
        return true;
      }
      if (!now_.state.tangent || cut_short(last_status_)) return false;
      omega = (omega + now_.omega) / 2;
    }
    return false;
  }

  Resonance run(double start, const Eigen::MatrixXd& guess) {
    guess_ = guess;
    const double lowest = start * (1 - peak_.search_range), highest = start * (1 + peak_.search_range);
    const auto climbs = [&] { return climbs_within(lowest, highest); };
    bool reached = go(start);
    // At an undamped glued resonance the condensed stiffness has a pole: step beside it.
    for (int i = 1; !reached && i <= 4; ++i) reached = go(start * (1 + 1e-6 * std::pow(10, i - 1) * (i % 2 ? 1 : -1)));
    if (!reached) return finish(last_status_);
    double before = 0, slope_before = 0;
    bool has_before = false;
    while (result_.solves < peak_.max_solves) {
      double step = predicted_step(has_before, before, slope_before);
      if (std::abs(step) <= 0.2 * peak_.frequency_tolerance * now_.omega && curved_down_)
        return finish(Status::converged);
      if (lower_ && upper_) {
        // A bracket may close on a kink of the curve, but not on a jump to another branch.
        if (*upper_ - *lower_ <= peak_.frequency_tolerance * now_.omega) {
          if (std::abs(upper_amplitude_ - lower_amplitude_) <= 1e-4 * now_.amplitude || climbs())
            return finish(Status::converged);
          return finish(spent(joint_.options.budget) ? Status::budget_spent : Status::no_bracket);
        }
        const double target = now_.omega + step;
        if (!(target > *lower_ && target < *upper_) || stalling()) step = (*lower_ + *upper_) / 2 - now_.omega;
      }
      const double target = std::clamp(now_.omega + step, lowest, highest);
      if (target == now_.omega) return finish(Status::no_bracket);
      const double amplitude_before = now_.amplitude;
      const int jacobians_before = result_.jacobians;
      before = now_.omega;
      slope_before = now_.slope / now_.amplitude;
      has_before = true;
      if (!go(target)) return finish(result_.solves >= peak_.max_solves ? Status::iteration_limit : last_status_);
      if (now_.amplitude < amplitude_before && result_.jacobians - jacobians_before > kHard && climbs())
        return finish(Status::converged);
    }
    return finish(Status::iteration_limit);
  }

 private:
  void accept(steady::State state) {
    const AmplitudeSlope at = amplitude_slope(state, peak_.output);
    const OutputSlope first = output_slope(state, peak_.output);
    now_.omega = state.omega;
    now_.amplitude = at.amplitude;
    now_.slope = at.slope;
    if (!highest_ || at.amplitude > highest_->amplitudes(peak_.output)) {
      highest_ = state;
      climbed_ = false;
    }
    const std::complex<double> y(first.value(1), -first.value(2)), dy(first.slope(1), -first.slope(2));
    now_.pole = dy != 0.0 ? now_.omega + y / dy : std::complex<double>(now_.omega, 1e-3 * now_.omega);
    now_.state = std::move(state);
    if (now_.slope > 0 && (!lower_ || now_.omega > *lower_)) {
      lower_ = now_.omega;
      lower_amplitude_ = now_.amplitude;
    }
    if (now_.slope <= 0 && (!upper_ || now_.omega < *upper_)) {
      upper_ = now_.omega;
      upper_amplitude_ = now_.amplitude;
    }
    // Two peaks, or a fold, can cross the marks: keep the newest one.
    if (lower_ && upper_ && *lower_ >= *upper_) (now_.slope > 0 ? upper_ : lower_).reset();
    widths_.push_back(lower_ && upper_ ? *upper_ - *lower_ : kInfinity);
  }

  // Far away towards the pole of the one-mode model, near by along the secant of the logarithmic slope.
  double predicted_step(bool has_before, double before, double slope_before) {
    const double width = std::max(std::abs(now_.pole.imag()), 1e-9 * now_.omega);
    const double to_pole = now_.pole.real() - now_.omega;
    const double slope = now_.slope / now_.amplitude;
    curved_down_ = false;
    if (std::abs(to_pole) > 0.5 * width && !(lower_ && upper_)) {
      const double limit = 0.05 * now_.omega;
      double step = std::clamp(to_pole, -limit, limit);
      // The slope knows better on which side the maximum is.
      if ((step > 0) != (now_.slope > 0)) step = std::copysign(std::min(2 * width, limit), now_.slope);
      return step;
    }
    double curvature = -1 / (width * width);
    if (has_before && before != now_.omega) {
      const double secant = (slope - slope_before) / (now_.omega - before);
      if (secant < 0) curvature = secant;
    }
    curved_down_ = true;
    return std::clamp(-slope / curvature, -4 * width, 4 * width);
  }

  // A curve that leans over has no maximum that steps in frequency could close in on: they fall off the higher branch,
  // after many Jacobians. From the highest point so far Newton on (U, omega) gets there; each point is tried once.
  bool climbs_within(double lowest, double highest) {
    if (climbed_) return false;
    climbed_ = true;
    const branches::Equations equations(joint_, highest_->penalty_ratio);
    std::optional<steady::State> top = climb(equations, *highest_, peak_width(*highest_, peak_.output), peak_, result_);
    if (!top || top->omega < lowest || top->omega > highest) return false;
    accept(std::move(*top));
    return true;
  }

  // Three points without halving the bracket: the slope has a kink there, so bisect.
  [[nodiscard]] bool stalling() const {
    const std::size_t n = widths_.size();
    return n > 3 && widths_[n - 1] > 0.5 * widths_[n - 4];
  }

  Resonance finish(Status status) {
    result_.status = status;
    result_.omega = now_.omega;
    result_.amplitude = now_.amplitude;
    result_.slope = now_.slope;
    result_.state = std::move(now_.state);
    return std::move(result_);
  }

  steady::Joint joint_;
  const ResonanceOptions& peak_;
  Eigen::MatrixXd guess_;
  Point now_;
  static constexpr int kHard = 12;  // Jacobians: a step within one branch takes fewer
  std::optional<steady::State> highest_;
  bool climbed_ = false;
  Resonance result_;
  Status last_status_ = Status::no_bracket;
  std::optional<double> lower_, upper_;
  double lower_amplitude_ = 0, upper_amplitude_ = 0;
  std::vector<double> widths_;
  bool curved_down_ = false;
};

/// Where the search begins: the frequency and, unless empty, the displacement there.
struct PeakStart {
  double omega = 0;
  Eigen::MatrixXd guess;
  int solves = 0, jacobians = 0;  ///< spent on finding it
};

/// With many harmonics the way to the peak is found with half of them, at an eighth of the cost of a step; what is left
/// is a short way on which Newton's method does not have to find out which nodes slip.
PeakStart with_fewer_harmonics(steady::Joint joint, PeakStart start, const ResonanceOptions& peak) {
  constexpr int kMany = 9;
  if (joint.options.harmonics < kMany) return start;
  const Eigen::Index all = 2 * joint.options.harmonics + 1;
  joint.options.harmonics /= 2;
  const Eigen::Index few = 2 * joint.options.harmonics + 1;
  PeakStart first = start;
  if (first.guess.cols() > few) first.guess.conservativeResize(Eigen::NoChange, few);
  first = with_fewer_harmonics(joint, std::move(first), peak);
  const Resonance found = PeakSearch(joint, peak).run(first.omega, first.guess);
  start.solves = first.solves + found.solves;
  start.jacobians = first.jacobians + found.jacobians;
  if (found.status != Status::converged) return start;
  Eigen::MatrixXd guess = Eigen::MatrixXd::Zero(found.state.displacement.rows(), all);
  guess.leftCols(few) = found.state.displacement;
  start.omega = found.omega;
  start.guess = std::move(guess);
  return start;
}

/// A peak that only another pseudo-penalty led to may be one of another branch: it is looked for again from frequencies
/// beside it. One found with the pseudo-penalty asked for counts where it is no lower.
void look_again(const steady::Joint& joint, const ResonanceOptions& peak, Resonance& found) {
  constexpr double kBeside = 1e-3;  // of the frequency, the half width of a peak with little damping
  const double omega = found.omega;
  for (const double start : {omega * (1 - kBeside), omega * (1 + kBeside)}) {
    if (found.status != Status::converged || found.state.penalty_ratio == 1) return;
    Resonance other = PeakSearch(joint, peak).run(start, {});
    other.solves += found.solves;
    other.jacobians += found.jacobians;
    const bool counts = other.status == Status::converged && other.state.penalty_ratio == 1 &&
                        other.amplitude >= 0.999 * found.amplitude;
    if (counts)
      found = std::move(other);
    else
      found.solves = other.solves, found.jacobians = other.jacobians;
  }
}

}  // namespace

AmplitudeSlope amplitude_slope(const steady::State& state, Eigen::Index output) {
  const OutputSlope slope = output_slope(state, output);
  const dynamics::Extremes ends = dynamics::extremes(slope.value);
  // The extremes are stationary in time: only the coefficients move them, to first order.
  const Eigen::Index k = slope.value.size();
  const double change =
      (dynamics::fourier_row(ends.tau_maximum, k) - dynamics::fourier_row(ends.tau_minimum, k)).dot(slope.slope) / 2;
  return {.amplitude = ends.amplitude(), .slope = change};
}

Resonance resonance(const steady::Joint& joint, double omega_start, const ResonanceOptions& resonance_options,
                    const Eigen::MatrixXd& guess) {
  std::vector<Violation> found = violations(resonance_options);
  const auto outputs = static_cast<int>(joint.model->output_names().size());
  if (resonance_options.output >= outputs)
    found.push_back({.file = {},
                     .key = "output",
                     .value = std::to_string(resonance_options.output),
                     .allowed = "must be < " + std::to_string(outputs)});
  if (!found.empty()) throw InputError(std::move(found));
  const PeakStart start = with_fewer_harmonics(
      joint, {.omega = omega_start, .guess = guess, .solves = 0, .jacobians = 0}, resonance_options);
  Resonance near = PeakSearch(joint, resonance_options).run(start.omega, start.guess);
  near.solves += start.solves;
  near.jacobians += start.jacobians;
  look_again(joint, resonance_options, near);
  if (near.status == Status::converged || cut_short(near.status) || resonance_options.sweep_range == 0) return near;
  Resonance far = peak_sweep(joint, omega_start * (1 + resonance_options.search_range),
                             omega_start * (1 - resonance_options.sweep_range), resonance_options);
  far.swept = true;
  far.solves += near.solves;
  far.jacobians += near.jacobians;
  if (far.status == Status::converged) return far;
  near.solves = far.solves;
  near.jacobians = far.jacobians;
  return near;
}

}  // namespace dovetail::paths
