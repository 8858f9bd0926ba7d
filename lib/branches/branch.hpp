#pragma once

#include <functional>
#include <memory>

#include "branches/arc.hpp"

namespace dovetail::branches {

/// The direction t of a branch at a point, J dU + df/ds ds = 0, with <along, t> = 1: it points the way `along` does.
/// Its length is 1 / cos of the angle between the two (when `along` has length 1).
struct Direction {
  Status status = Status::singular;
  Vector direction;
};

/// f(U, s) = 0 over a parameter s: everything the points of one branch share.
class Equations {
 public:
  /// The problem at s; null where it cannot be set up.
  using ProblemAt = std::function<std::shared_ptr<const steady::Problem>(double parameter)>;
  /// df/ds [nc, 2H+1] at a point with its derivative.
  using Slope = std::function<Eigen::MatrixXd(const steady::Point& point)>;

  /// Over any parameter. Of `options` the tolerance, linearise and the budget count, and the samples for turns.
  Equations(steady::Options options, ProblemAt problem_at, Slope slope);
  /// Over the frequency omega (rad/s) of a joint, at one pseudo-penalty. There is no problem for omega <= 0, nor at an
  /// undamped glued resonance.
  Equations(const steady::Joint& joint, double penalty_ratio);

  [[nodiscard]] const steady::Options& options() const { return options_; }
  [[nodiscard]] std::shared_ptr<const steady::Problem> at(double parameter) const { return problem_at_(parameter); }
  /// df/ds over vec(U) at a point with its derivative.
  [[nodiscard]] Eigen::VectorXd slope(const steady::Point& point) const { return slope_(point).reshaped(); }
  /// The direction of the branch at the point of `tangent`, by one bordered solve.
  [[nodiscard]] Direction direction(const steady::Tangent& tangent, const Vector& along, const ArcMetric& metric) const;

  struct Correction {
    Status status = Status::iteration_limit;
    Vector at;
    steady::Point point = {};  ///< there, when converged
    int iterations = 0;        ///< Jacobians
    int evaluations = 0;       ///< residuals
  };
  /// Newton on (U, s) for f = 0 and <row, x - start> = 0, from `start`. O(1) factorisation per iteration.
  [[nodiscard]] Correction correct(const Vector& start, const Vector& row, const ArcMetric& metric,
                                   int max_iterations) const;
  /// The same at a fixed parameter, start.parameter exactly.
  [[nodiscard]] Correction correct_at(const Vector& start, int max_iterations) const;
  struct Described {
    steady::State state;
    std::shared_ptr<const steady::Tangent> tangent;  ///< null unless state.status is converged
  };
  /// Everything reported of a corrected point; singular when nothing holds the body there. At a turning point J may be
  /// singular without harm: there the state carries no tangent, but `tangent` is there for a bordered system.
  [[nodiscard]] Described describe(const Correction& found, const Vector& along, const ArcMetric& metric) const;

 private:
  steady::Options options_;
  ProblemAt problem_at_;
  Slope slope_;
};

}  // namespace dovetail::branches
