#include "paths/backbone.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "paths/params.hpp"
#include "paths/peak.hpp"
#include "paths/peak_sweep.hpp"
#include "paths/reach.hpp"

namespace dovetail::paths {
namespace {

// A resonance that was found, as a support of the predictor.
struct Support {
  double parameter = 0;
  branches::Vector point;
};

class Tracker {
 public:
  Tracker(const BackboneFamily& family, const BackboneOptions& backbone) : family_(family), backbone_(backbone) {}

  BackbonePoint first(double parameter, double omega_start) {
    omega_start_ = checked_ = omega_start;
    BackbonePoint found = searched(parameter, omega_start, {}, backbone_.resonance);
    check(found);
    return found;
  }

  // Followed from the point before, then held against the others.
  BackbonePoint next(double parameter) {
    BackbonePoint found = followed(parameter);
    check(found);
    if (found.status == Status::converged || !backbone_.search || backbone_.check_range == 0) return found;
    BackbonePoint anew = searched(parameter, omega_start_, {}, backbone_.resonance);
    anew.jacobians += found.jacobians;
    anew.checking = found.checking;
    anew.jumped = anew.status == Status::converged;
    return anew;
  }

  [[nodiscard]] bool started() const { return !supports_.empty(); }

 private:
  // Newton from the predictor, over intermediate parameters when the way is too far, then resonance() as a last resort.
  BackbonePoint followed(double parameter) {
    BackbonePoint found;
    int jacobians = 0;
    const Reach reached = reach(supports_.back().parameter, parameter, backbone_.halvings, [&](double target) {
      found = newton(target);
      jacobians += found.jacobians;
      return found.status == Status::converged;
    });
    if (!reached.there && backbone_.search) {
      // Followed, not searched anew: elsewhere there may be the peak of another mode.
      ResonanceOptions near = backbone_.resonance;
      near.sweep_range = 0;
      const Support& last = supports_.back();
      found = searched(parameter, last.point.parameter, last.point.displacement, near);
      jacobians += found.jacobians;
    } else if (!reached.there) {
      found = {.parameter = parameter, .status = found.status, .state = {}};
    }
    found.intermediate = reached.intermediate;
    found.jacobians = jacobians;
    return found;
  }

  // Takes the highest peak of the branch around `point`, and from there to the last one that is known to be the
  // highest, instead of it, when that is higher or the point failed.
  void check(BackbonePoint& point, int rounds = kParams.rounds) {
    if (backbone_.check_range == 0) return;
    const bool known = point.status == Status::converged;
    const double middle = known ? point.omega : supports_.empty() ? omega_start_ : supports_.back().point.parameter;
    const double low = std::min(middle, checked_) * (1 - backbone_.check_range);
    const double high = std::max(middle, checked_) * (1 + backbone_.check_range);
    const steady::Joint joint = family_(point.parameter);
    Resonance swept = peak_sweep(joint, low, high, backbone_.resonance);
    point.checking += swept.jacobians;
    // Where there is no peak to be held against, far out as well.
    if (swept.status != Status::converged && !known && backbone_.search) {
      swept = peak_sweep(joint, low / kParams.far, kParams.far * high, backbone_.resonance);
      point.checking += swept.jacobians;
    }
    if (swept.status != Status::converged) return;
    // What stands as high as the highest point of the branch has been held against all of it. A branch that is higher
    // at an end of the range rises to another peak beyond it.
    const double noise = 1 + noise_of_peaks(joint.options);
    const double highest = std::max(swept.amplitude, known ? point.amplitude : 0.0);
    point.checked = std::max(swept.unresolved, swept.ends) <= noise * highest;
    if (known && swept.amplitude <= (1 + kParams.same) * point.amplitude) return keep_checked(point);
    point.jumped = !known || swept.amplitude > noise * point.amplitude;
    point.status = Status::converged;
    point.searched = true;
    adopt(std::move(swept), point);
    // Elsewhere the range contains others.
    if (rounds > 1 && std::abs(point.omega / middle - 1) > kParams.moved) return check(point, rounds - 1);
    keep_checked(point);
  }

  void keep_checked(const BackbonePoint& point) {
    if (point.checked) checked_ = point.omega;
  }

  BackbonePoint searched(double parameter, double omega_start, const Eigen::MatrixXd& guess,
                         const ResonanceOptions& search) {
    Resonance found = resonance(family_(parameter), omega_start, search, guess);
    BackbonePoint point{.parameter = parameter,
                        .status = found.status,
                        .omega = found.omega,
                        .amplitude = found.amplitude,
                        .searched = true,
                        .jacobians = found.jacobians,
                        .state = {}};
    if (point.status == Status::converged) adopt(std::move(found), point);
    return point;
  }

  void adopt(Resonance found, BackbonePoint& point) {
    point.omega = found.omega;
    point.amplitude = found.amplitude;
    point.error = backbone_.resonance.frequency_tolerance;
    point.state = std::move(found.state);
    // A polynomial through the points of another peak, or at another eps, predicts nothing.
    if (!started() || point.jumped) {
      supports_.clear();
      penalty_ratio_ = point.state.penalty_ratio;
    }
    keeps_tangents_ = family_(point.parameter).options.linearise;
    keep({.parameter = point.parameter, .point = {.displacement = point.state.displacement, .parameter = point.omega}});
    last_state_ = point.state;
    last_state_.tangent.reset();
    width_ = amplitude_slope(point.state, backbone_.resonance.output).width;
    if (!keeps_tangents_) point.state.tangent.reset();
  }

  BackbonePoint newton(double parameter) {
    const branches::Equations branch(family_(parameter), penalty_ratio_);
    const branches::ArcMetric metric = peak_metric(last_state_, width_);
    const PeakOptions peak{.output = backbone_.resonance.output,
                           .frequency_tolerance = backbone_.resonance.frequency_tolerance,
                           .max_iterations = backbone_.max_iterations};
    const branches::Vector start = predicted(parameter);
    const Peak found = find_peak(branch, start, metric, peak);
    BackbonePoint point{.parameter = parameter,
                        .status = found.status,
                        .omega = found.at.parameter,
                        .amplitude = found.amplitude,
                        .error = found.error,
                        .jacobians = found.iterations,
                        .state = {}};
    if (point.status != Status::converged) return point;
    // A peak this far from where it was expected is another one.
    if (std::abs(found.at.parameter / supports_.back().point.parameter - 1) > kParams.elsewhere) {
      point.status = Status::stalled;
      return point;
    }
    point.state = described(branch, found, metric);
    point.status = point.state.status;
    if (point.status != Status::converged) return point;
    keep({.parameter = parameter, .point = found.at});
    last_state_ = point.state;
    last_state_.tangent.reset();
    width_ = std::clamp(found.width, kParams.narrower * width_, kParams.wider * width_);
    return point;
  }

  [[nodiscard]] branches::Vector predicted(double parameter) const {
    // Lagrange's polynomial through the last points, of which none may coincide.
    branches::Vector result = 0 * supports_.back().point;
    for (std::size_t i = 0; i < supports_.size(); ++i) {
      double weight = 1;
      for (std::size_t j = 0; j < supports_.size(); ++j)
        if (j != i) weight *= (parameter - supports_[j].parameter) / (supports_[i].parameter - supports_[j].parameter);
      result = result + weight * supports_[i].point;
    }
    return result;
  }

  void keep(Support support) {
    std::erase_if(supports_, [&](const Support& old) { return old.parameter == support.parameter; });
    supports_.push_back(std::move(support));
    if (supports_.size() > kParams.supports) supports_.erase(supports_.begin());
  }

  static constexpr BackboneParams kParams = {};

  const BackboneFamily& family_;
  const BackboneOptions& backbone_;
  std::vector<Support> supports_;
  steady::State last_state_;
  bool keeps_tangents_ = true;
  double penalty_ratio_ = 1, width_ = 0, omega_start_ = 0;
  double checked_ = 0;  // rad/s, of the last point that was the highest, in the beginning omega_start
};

}  // namespace

Backbone backbone(const BackboneFamily& family, std::span<const double> parameters, double omega_start,
                  const BackboneOptions& backbone_options, const std::function<bool(const BackbonePoint&)>& progress) {
  std::vector<Violation> found = violations(backbone_options.resonance, "resonance");
  std::ranges::move(violations(backbone_options), std::back_inserter(found));
  if (!found.empty()) throw InputError(std::move(found));
  Tracker tracker(family, backbone_options);
  Backbone result{.status = Status::converged, .points = {}};
  bool stopped = false;
  for (const double parameter : parameters) {
    if (stopped) {
      result.points.push_back({.parameter = parameter, .status = Status::interrupted, .state = {}});
      continue;
    }
    result.points.push_back(tracker.started() ? tracker.next(parameter) : tracker.first(parameter, omega_start));
    const BackbonePoint& point = result.points.back();
    result.jacobians += point.jacobians + point.checking;
    if (point.status != Status::converged) result.status = point.status;
    stopped = progress && !progress(point);
  }
  if (stopped && result.points.back().status == Status::interrupted) result.status = Status::interrupted;
  return result;
}

}  // namespace dovetail::paths
