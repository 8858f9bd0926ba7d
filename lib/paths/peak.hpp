#pragma once

#include "branches/branch.hpp"
#include "paths/amplitude.hpp"

namespace dovetail::paths {

struct PeakOptions {
  int output = 0;
  double frequency_tolerance = 1e-7;  ///< of omega, relative, > 0
  int max_iterations = 60;            ///< Jacobians, >= 2
};

struct Peak {
  Status status = Status::iteration_limit;
  branches::Vector at;
  double amplitude = 0;
  double slope = 0;     ///< change of the amplitude with the arc length, relative to the amplitude
  double width = 0;     ///< the frequency range in which the output changes by its own size there, rad/s
  double error = 0;     ///< of omega: the correction that was left or the bracket it is in, relative
  int iterations = 0;   ///< Jacobians
  int evaluations = 0;  ///< residuals
  std::shared_ptr<const steady::Point> point = {};
};

/// Arc length near a peak: one unit is a change of the contact's vibration by its own size, or of the frequency by
/// `width`.
[[nodiscard]] branches::ArcMetric peak_metric(const steady::State& state, double width);

/// Newton on (U, omega) for f = 0 and dA/ds = 0, A the amplitude of one output and s the arc length, from `start` near
/// the maximum of a branch. Each iteration takes one factorisation of J: the bordered system gives the tangent, the
/// correction towards the branch and dA/ds; the second derivative comes from successive points, because f is piecewise
/// smooth and a local one says nothing of the way the contact changes. It works through turning points. dA/ds jumps
/// where samples change their contact state, and a maximum at such a jump is accepted when its bracket is as narrow as
/// the tolerance.
[[nodiscard]] Peak find_peak(const branches::Equations& branch, const branches::Vector& start,
                             const branches::ArcMetric& metric, const PeakOptions& options);

/// The steady state at a converged peak, with its tangent unless that is singular.
[[nodiscard]] steady::State described(const branches::Equations& branch, const Peak& peak,
                                      const branches::ArcMetric& metric);

}  // namespace dovetail::paths
