#pragma once

#include <optional>

#include "branches/branch.hpp"
#include "branches/follow.hpp"

namespace dovetail::branches {

/// A point of a branch with what the next step needs: the unit tangent and the metric in which it is one.
struct Station {
  Vector at;
  Vector tangent;
  ArcMetric metric;
  steady::State state;
  double step = 0;           ///< arc length from the station before
  double turn_angle = 0;     ///< between its tangent and the one before, rad, [0, pi]
  double output_change = 0;  ///< from the station before, relative
  int iterations = 0;
  int orientation = 0;    ///< sign of det J times that of the parameter's change onwards; 0: not known
  bool doubtful = false;  ///< det J and the way come disagree on where onwards is

  /// Change of the parameter with the arc length, in the units of the metric.
  [[nodiscard]] double slope() const { return metric.parameter_weight * tangent.parameter; }
};

/// Makes stations of a branch: the corrector and everything said of its result.
class StationMaker {
 public:
  /// Over an interval of this size; refers to `equations` and `follow`.
  StationMaker(const Equations& equations, const FollowOptions& follow, double interval)
      : equations_(equations), follow_(follow), interval_(interval) {}

  /// The first station from a steady state with its tangent, at `parameter`; its own in the sense of `sign` of that.
  [[nodiscard]] std::optional<Station> first(steady::State state, double parameter, double sign);
  /// A converged point near now + step direction, in the plane through that across `direction`.
  [[nodiscard]] std::optional<Station> advance(const Station& now, const Vector& direction, double step);
  /// The same at a given parameter, near a point that lies `step` ahead.
  [[nodiscard]] std::optional<Station> at_parameter(const Station& now, const Vector& start, double step);
  /// The unit tangent of the piece of the branch that holds at now + step direction, whether the branch is there or
  /// not, oriented by det J.
  [[nodiscard]] std::optional<Vector> tangent_ahead(const Station& now, const Vector& direction, double step);

  [[nodiscard]] Status failure() const { return failure_; }  ///< of the last that was not made
  [[nodiscard]] int jacobians() const { return jacobians_; }
  [[nodiscard]] int evaluations() const { return evaluations_; }

 private:
  std::optional<Station> described(const Station& now, const Equations::Correction& found, const Vector& direction,
                                   double step);
  ArcMetric metric_at(const steady::State& state);
  [[nodiscard]] double output_change(const steady::State& before, const steady::State& after) const;

  const Equations& equations_;
  const FollowOptions& follow_;
  double interval_;
  Status failure_ = Status::stalled;
  int jacobians_ = 0, evaluations_ = 0;
  double largest_forces_ = 0, largest_output_ = 0;
};

}  // namespace dovetail::branches
