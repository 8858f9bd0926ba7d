#pragma once

#include <memory>

#include "paths/arc.hpp"

namespace dovetail::paths {

/// f(U, omega) = 0 of a joint at one pseudo-penalty: everything the points of one branch share.
class BranchEquations {
 public:
  BranchEquations(steady::Joint joint, double penalty_ratio)
      : joint_(std::move(joint)), penalty_ratio_(penalty_ratio) {}

  [[nodiscard]] const dynamics::CondensedModel& model() const { return *joint_.model; }
  [[nodiscard]] const steady::Options& options() const { return joint_.options; }

  /// The problem at omega; null where it cannot be set up (omega <= 0, an undamped glued resonance).
  [[nodiscard]] std::shared_ptr<const steady::Problem> at(double omega) const;

  struct Correction {
    Status status = Status::iteration_limit;
    BranchVector at;
    steady::Point point = {};  ///< there, when converged
    int iterations = 0;        ///< Jacobians
    int evaluations = 0;       ///< residuals
  };
  /// Newton on (U, omega) for f = 0 and <row, x - start> = 0, from `start`. O(1) factorisation per iteration.
  [[nodiscard]] Correction correct(const BranchVector& start, const BranchVector& row, const ArcMetric& metric,
                                   int max_iterations) const;
  /// The same at fixed frequency, start.omega exactly.
  [[nodiscard]] Correction correct_at(const BranchVector& start, int max_iterations) const;
  struct Described {
    steady::State state;
    std::shared_ptr<const steady::Tangent> tangent;  ///< null unless state.status is converged
  };
  /// Everything reported of a corrected point; singular when nothing holds the body there. At a turning point J may be
  /// singular without harm: there the state carries no tangent, but `tangent` is there for a bordered system.
  [[nodiscard]] Described describe(const Correction& found, const BranchVector& along, const ArcMetric& metric) const;

 private:
  steady::Joint joint_;
  double penalty_ratio_;
};

/// The direction t of the branch at a point, J dU + df/dw dw = 0, with <along, t> = 1 in `metric`: it points the way
/// `along` does. Its length is 1 / cos of the angle between the two (when `along` has length 1).
struct BranchDirection {
  Status status = Status::singular;
  BranchVector direction;
};
[[nodiscard]] BranchDirection branch_direction(const steady::Tangent& tangent, const BranchVector& along,
                                               const ArcMetric& metric);

}  // namespace dovetail::paths
