#pragma once

#include <Eigen/Core>
#include <memory>

#include "numerics/fourier.hpp"
#include "response/steady_state.hpp"

namespace dovetail::response {

/// A point or a direction in the space of displacements and frequency.
struct BranchVector {
  Eigen::MatrixXd displacement;  ///< [nc, 2H+1], m
  double omega = 0;              ///< rad/s
};

/// Lengths in that space: |(dU, dw)|^2 = sum (eps dU / F)^2 + (dw / w)^2, F and w chosen so that both terms are O(1).
struct ArcMetric {
  Eigen::VectorXd displacement_weight;  ///< eps / F of each contact dof [nc], 1/m
  double omega_weight = 1;              ///< 1/w, s

  [[nodiscard]] double inner(const BranchVector& a, const BranchVector& b) const;
  [[nodiscard]] double length(const BranchVector& a) const;
};

/// f(U, omega) = 0 at one pseudo-penalty: everything the points of one branch share.
class BranchEquations {
 public:
  BranchEquations(std::shared_ptr<const CondensedModel> model, const ContactCondition& condition,
                  const SteadyOptions& options, double penalty_ratio);

  [[nodiscard]] const CondensedModel& model() const { return *model_; }
  [[nodiscard]] const SteadyOptions& options() const { return options_; }
  [[nodiscard]] double penalty_ratio() const { return penalty_ratio_; }

  /// The residual at omega; null where it cannot be set up (omega <= 0, an undamped glued resonance).
  [[nodiscard]] std::shared_ptr<const SteadyResidual> at(double omega) const;

  struct Correction {
    Status status = Status::iteration_limit;
    BranchVector point;
    std::shared_ptr<const SteadyResidual> residual = {};  ///< at the point, when converged
    int iterations = 0;                                   ///< Jacobians
    int evaluations = 0;                                  ///< residuals
    double error = 0;                                     ///< |f| relative to the excitation
  };
  /// Newton on (U, omega) for f = 0 and <row, x - start> = 0, from `start`. O(1) factorisation per iteration.
  [[nodiscard]] Correction correct(const BranchVector& start, const BranchVector& row, const ArcMetric& metric,
                                   int max_iterations) const;
  /// The same at fixed frequency, start.omega exactly.
  [[nodiscard]] Correction correct_at(const BranchVector& start, int max_iterations) const;
  struct Described {
    SteadyState state;
    std::shared_ptr<const Linearisation> linear;  ///< null unless state.status is converged
  };
  /// Everything reported of a corrected point; singular when nothing holds the body there. At a turning point J may be
  /// singular without harm: there the state carries no linearisation, but `linear` is there for a bordered system.
  [[nodiscard]] Described describe(const Correction& found, const BranchVector& along, const ArcMetric& metric) const;

 private:
  std::shared_ptr<const CondensedModel> model_;
  ContactCondition condition_;
  SteadyOptions options_;
  double penalty_ratio_;
  numerics::FourierBasis basis_;
};

/// The tangent t of the branch at a linearised point, J dU + df/dw dw = 0, with <along, t> = 1 in `metric`: it points
/// the way `along` does. Its length is 1 / cos of the angle between the two (when `along` has length 1).
struct TangentResult {
  Status status = Status::singular;
  BranchVector tangent;
};
[[nodiscard]] TangentResult tangent(const Linearisation& linear, const BranchVector& along, const ArcMetric& metric);

}  // namespace dovetail::response
