#pragma once

#include <Eigen/Core>
#include <functional>

#include "core/status.hpp"

namespace dovetail::numerics {

struct NewtonParams {
  double tolerance = 1e-9;      ///< on the Euclidean norm of the (scaled) residual, > 0
  int max_iterations = 60;      ///< Jacobians, >= 0
  int memory = 5;               ///< a step may raise the norm up to the largest of the last `memory` ones, >= 1
  double decrease = 1e-4;       ///< sufficient decrease per unit step, (0, 0.5)
  double shortest_cut = 0.1;    ///< of a step that decreases too little, least and
  double longest_cut = 0.5;     ///< largest factor, (0, 1)
  double smallest_step = 1e-3;  ///< shortest fraction of the Newton step that is tried, (0, 1)
  int max_failed_searches = 3;  ///< searches without decrease that are accepted at their best step, >= 0
  double chord_ratio = 0.3;     ///< a chord step is accepted when it reduces the norm to this fraction, (0, 1)
};

struct NewtonStats {
  Status status = Status::iteration_limit;
  int iterations = 0;    ///< Newton steps = Jacobians
  int chords = 0;        ///< accepted steps with a kept factorisation
  int evaluations = 0;   ///< residuals
  double residual = 0;   ///< norm at the returned point
  double reduction = 1;  ///< last ratio of norms: near 0 means quadratic convergence
};

/// What a system must offer. Both act on the last point given to `residual`, so that the work of an
/// evaluation is not repeated for its Jacobian.
struct NewtonSystem {
  /// Residual r(x); sets `x` as the current point. Unknowns and residuals scaled to O(1).
  std::function<Eigen::VectorXd(const Eigen::VectorXd& x)> residual;
  /// Writes d with J(x) d = -r(x) at the current point; anything but converged ends the iteration.
  std::function<Status(Eigen::VectorXd& step)> newton_step;
  /// Writes d with A d = -r(x) at the current point for a factorisation A kept from an earlier point; false when there
  /// is none worth trying. May be empty. Tried before every Newton step, since it costs a residual and a back
  /// substitution only, and kept while it contracts well.
  std::function<bool(Eigen::VectorXd& step)> chord_step = {};
};

/// Newton's method globalised by a non-monotone backtracking search on |r|^2 [Grippo, Lampariello & Lucidi 1986],
/// for equations that are semi-smooth: full steps converge quadratically near the solution, and because the
/// norm may rise for a few steps a kink does not trap the iteration. `x` holds the start and receives the best
/// point. Guarantee: converged only when |r(x)| <= tolerance at the returned x.
NewtonStats newton(const NewtonSystem& system, Eigen::VectorXd& x, const NewtonParams& params = {});

}  // namespace dovetail::numerics
