#pragma once

#include <optional>

#include "paths/branch.hpp"
#include "paths/continuation.hpp"

namespace dovetail::paths {

/// A point of a branch with what the next step needs: the unit tangent and the metric in which it is one.
struct Station {
  BranchVector at;
  BranchVector tangent;
  ArcMetric metric;
  steady::State state;
  double step = 0;           ///< arc length from the station before
  double turn_angle = 0;     ///< between its tangent and the one before, rad, [0, pi]
  double output_change = 0;  ///< from the station before, relative
  int iterations = 0;
  int orientation = 0;    ///< sign of det J times that of d omega / ds onwards; 0: not known
  bool doubtful = false;  ///< det J and the way come disagree on where onwards is

  [[nodiscard]] double slope() const { return metric.omega_weight * tangent.omega; }
};

/// Makes stations of a branch: the corrector and everything said of its result.
class StationMaker {
 public:
  StationMaker(const steady::Joint& joint, const ContinuationOptions& follow, double interval, double penalty_ratio);

  /// The first station from a steady state with its tangent, its tangent in the sense of `sign` of the frequency.
  [[nodiscard]] std::optional<Station> first(steady::State state, double sign);
  /// A converged point near now + step direction, in the plane through that across `direction`.
  [[nodiscard]] std::optional<Station> advance(const Station& now, const BranchVector& direction, double step);
  /// The same at a given frequency, near a point that lies `step` ahead.
  [[nodiscard]] std::optional<Station> at_frequency(const Station& now, const BranchVector& start, double step);
  /// The unit tangent of the piece of the branch that holds at now + step direction, whether the branch is there or
  /// not, oriented by det J.
  [[nodiscard]] std::optional<BranchVector> tangent_ahead(const Station& now, const BranchVector& direction,
                                                          double step);

  [[nodiscard]] Status failure() const { return failure_; }  ///< of the last that was not made
  [[nodiscard]] int jacobians() const { return jacobians_; }
  [[nodiscard]] int evaluations() const { return evaluations_; }

 private:
  std::optional<Station> described(const Station& now, const BranchEquations::Correction& found,
                                   const BranchVector& direction, double step);
  ArcMetric metric_at(const steady::State& state);
  [[nodiscard]] double output_change(const steady::State& before, const steady::State& after) const;

  BranchEquations equations_;
  const ContinuationOptions& follow_;
  double interval_;
  bool keeps_tangents_;
  Status failure_ = Status::stalled;
  int jacobians_ = 0, evaluations_ = 0;
  double largest_forces_ = 0, largest_output_ = 0;
};

}  // namespace dovetail::paths
