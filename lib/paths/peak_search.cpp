#include "paths/peak_search.hpp"

#include <algorithm>
#include <cmath>

#include "paths/amplitude.hpp"
#include "paths/params.hpp"
#include "paths/peak.hpp"
#include "paths/stationarity.hpp"

namespace dovetail::paths {
namespace {

constexpr ClosingInParams kClosingIn;
constexpr ClimbParams kClimb;

// A point of the response curve near its peak.
struct Summit {
  double omega = 0;
  AmplitudeSlope at;
  steady::State state;
};

class PeakSearch {
 public:
  PeakSearch(const steady::Joint& joint, const ResonanceOptions& peak, double start)
      : joint_(joint),
        peak_(peak),
        start_(start),
        lowest_(start * (1 - peak.search_range)),
        highest_(start * (1 + peak.search_range)) {
    joint_.options.linearise = true;
  }

  Resonance run(const Eigen::MatrixXd& guess) {
    guess_ = guess;
    bool started = solved(joint_, start_);
    // At an undamped glued resonance the condensed stiffness has a pole: step beside it.
    for (int i = 1; !started && i <= kClosingIn.off_pole; ++i)
      started = solved(joint_, start_ * (1 + kClosingIn.off_pole_step * std::pow(10, i - 1) * (i % 2 ? 1 : -1)));
    if (!started) return finish(last_status_);
    Status status = closed_in();
    if (status != Status::converged && !cut_short(status))
      status = climbed() ? Status::converged : within(joint_.options.budget, status);
    return finish(status);
  }

 private:
  // Steps in frequency to the zero of the slope: far away towards the pole of a linear peak through the point, which
  // lies (A'/A) w^2 away when w is its distance from the complex frequency; near by as Stationarity says.
  Status closed_in() {
    std::optional<Stationarity> near;
    Stationarity::Mark before;
    while (result_.solves < peak_.max_solves) {
      const Stationarity::Mark here = mark();
      const double width = now_.at.width, tolerated = peak_.frequency_tolerance * now_.omega;
      double step = here.slope * width * width;
      if (!near && (std::abs(step) <= kClosingIn.near * width || here.slope * before.slope < 0)) {
        near.emplace(-1 / (width * width), kClosingIn.trust * width);
        if (before.omega > 0) near->add(before);
      }
      if (near) {
        near->add(here);
        if (near->settled(tolerated)) return Status::converged;
        if (near->width() <= tolerated) return Status::no_bracket;  // the curve jumps to another branch there
        step = near->step(tolerated);
      } else {
        step = std::clamp(step, -kClosingIn.longest * now_.omega, kClosingIn.longest * now_.omega);
      }
      const double target = std::clamp(now_.omega + step, lowest_, highest_);
      if (target == now_.omega) return Status::no_bracket;
      before = here;
      const int jacobians_before = result_.jacobians;
      if (!go(target)) return last_status_;
      // A curve that leans over has no maximum that steps in frequency could close in on: they fall off it.
      if (now_.at.amplitude < before.amplitude && result_.jacobians - jacobians_before > kClosingIn.hard)
        return Status::no_bracket;
    }
    return Status::iteration_limit;
  }

  // From the highest point so far by Newton on (U, omega), which turning points do not stop.
  bool climbed() {
    const branches::Equations equations(joint_, top_.state.penalty_ratio);
    std::optional<steady::State> top = climb(equations, top_.state, top_.at.width, peak_, result_);
    if (!top || top->omega < lowest_ || top->omega > highest_) return false;
    accept(std::move(*top));
    return true;
  }

  // The response at omega, continued from the last point, or part of the way there. Where Newton's method alone does
  // not get there soon, half the way costs less than its rescues, and they may end on another branch: these come last.
  bool go(double omega) {
    steady::Joint cautious = joint_.with(joint_.options.plain());
    cautious.options.max_iterations = std::min(kClosingIn.hard, joint_.options.max_iterations);
    const auto tried = [&](const steady::Joint& joint, int tries) {
      double target = omega;
      for (int i = 0; i < tries && !cut_short(last_status_); ++i, target = (target + now_.omega) / 2)
        if (solved(joint, target)) return true;
      return false;
    };
    return (joint_.options.solver == steady::Solver::automatic && tried(cautious, kClosingIn.cautious)) ||
           tried(joint_, kClosingIn.tries);
  }

  bool solved(const steady::Joint& joint, double omega) {
    last_status_ = Status::iteration_limit;
    if (result_.solves >= peak_.max_solves) return false;
    Eigen::MatrixXd guess = guess_;
    if (now_.state.tangent)
      guess = now_.state.displacement + (omega - now_.omega) * now_.state.tangent->response_to_frequency();
    steady::State state = steady_state(joint, omega, guess, now_.state.tangent);
    ++result_.solves;
    result_.jacobians += state.iterations;
    last_status_ = state.status;
    if (last_status_ == Status::converged) accept(std::move(state));
    return last_status_ == Status::converged;
  }

  void accept(steady::State state) {
    now_.omega = state.omega;
    now_.at = amplitude_slope(state, peak_.output);
    now_.state = std::move(state);
    if (now_.at.amplitude > top_.at.amplitude) top_ = now_;
  }

  [[nodiscard]] Stationarity::Mark mark() const {
    const double relative = now_.at.amplitude > 0 ? now_.at.slope / now_.at.amplitude : 0;
    return {.place = now_.omega, .omega = now_.omega, .amplitude = now_.at.amplitude, .slope = relative};
  }

  Resonance finish(Status status) {
    result_.status = status;
    result_.omega = now_.omega;
    result_.amplitude = now_.at.amplitude;
    result_.slope = now_.at.slope;
    result_.state = std::move(now_.state);
    return std::move(result_);
  }

  steady::Joint joint_;
  const ResonanceOptions& peak_;
  double start_, lowest_, highest_;
  Eigen::MatrixXd guess_;
  Summit now_, top_;
  Resonance result_;
  Status last_status_ = Status::no_bracket;
};

}  // namespace

std::optional<steady::State> climb(const branches::Equations& equations, const steady::State& from, double width,
                                   const ResonanceOptions& options, Resonance& work) {
  const branches::ArcMetric metric = peak_metric(from, width);
  branches::Vector start{.displacement = from.displacement, .parameter = from.omega};
  double height = from.amplitudes(options.output);
  Peak peak;
  // Where the branch turns away from where it led at the start, the climb begins anew.
  for (int i = 0; i < kClimb.climbs; ++i) {
    peak = find_peak(equations, start, metric,
                     {.output = options.output, .frequency_tolerance = options.frequency_tolerance});
    ++work.solves;
    work.jacobians += peak.iterations;
    const bool ended = peak.status != Status::stalled && peak.status != Status::iteration_limit;
    if (ended || peak.amplitude < (1 + kClimb.gain) * height) break;
    height = peak.amplitude;
    start = peak.at;
  }
  if (peak.status != Status::converged || peak.amplitude < kClimb.height * from.amplitudes(options.output)) return {};
  steady::State state = described(equations, peak, metric);
  if (state.status != Status::converged || !state.tangent) return {};
  return state;
}

Resonance search_peak(const steady::Joint& joint, double omega_start, const ResonanceOptions& options,
                      const Eigen::MatrixXd& guess) {
  return PeakSearch(joint, options, omega_start).run(guess);
}

}  // namespace dovetail::paths
