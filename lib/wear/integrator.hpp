#pragma once

#include <Eigen/Core>
#include <memory>

#include "wear/history.hpp"
#include "wear/wear_point.hpp"
#include "wear/wearing_joint.hpp"

namespace dovetail::wear {

/// How far a history has come.
struct Course {
  double cycles = 0;
  WearPoint point;              ///< the last accepted state
  Eigen::VectorXd first_depth;  ///< [Nc] m, where the history began
  StepMemory memory;
  int rejected = 0;  ///< steps tried and shortened

  /// Depth that errors are measured by, were the joint worn to `depth`, m.
  [[nodiscard]] double error_scale(const Eigen::VectorXd& depth) const;
};

/// What carries a history from one state to the next.
class Integrator {
 public:
  virtual ~Integrator() = default;
  /// One step, at most to `limit` cycles: moves the course on, or leaves it and says why none could be made.
  [[nodiscard]] virtual Status advance(double limit, Course& course) = 0;
  /// The steady state at the last accepted point, with its tangent.
  [[nodiscard]] virtual steady::State state(const Course& course) const = 0;
};

/// Numbers of the explicit jumps.
struct ExplicitParams {
  int halvings = 8;           ///< times a jump whose state does not converge is halved before giving up
  double safety = 0.9;        ///< of the jump that the error permits
  double shortest_cut = 0.1;  ///< least and
  double longest_cut = 0.8;   ///< largest factor of a jump that erred too much
  double slowest = 0.5;       ///< least and
  double fastest = 2.0;       ///< largest factor from one jump to the next
  double unresolved = 1e-3;   ///< of the increment: shorter jumps pass whatever their error, the rates jump there
};

/// Cycle jumps of constant largest increment: with the rate dW of the state at W, N += dN, W += dN dW,
/// dN = increment / max dW [Salles 2009, eq. 20-22], each from U + dU, dU = -J^-1 J_W dW with the last factorisation
/// (eq. 33-35). A jump whose state does not converge is halved; with `tolerance` jumps are shortened to their local
/// error besides.
///
/// @param first  the state that the history begins or goes on with
[[nodiscard]] std::unique_ptr<Integrator> explicit_jumps(WearingJoint& joint, const HistoryOptions& options,
                                                         steady::State first, const ExplicitParams& params = {});

/// Numbers of the implicit steps.
struct ImplicitParams {
  double first_increment = 0.05;  ///< largest increase of depth in the first step, over the largest penetration
  double growth = 3.0;            ///< largest growth of the step from one to the next
  double shrinking = 0.3;         ///< least
  int stage_iterations = 10;      ///< Jacobians per stage before a step is cut
  double safety = 0.9;            ///< of the step that the error permits
  double shortest_cut = 0.1;      ///< least and
  double longest_cut = 0.7;       ///< largest factor of a step that erred too much
  double unsolved_cut = 0.25;     ///< factor of a step whose equations could not be solved;
  int recovery = 3;               ///< the next ones grow slowly,
  double slow_growth = 1.5;       ///< by so much at most
  double smallest = 1e-5;         ///< shortest step, relative to the depth, before the branch counts as ended;
  double leap = 100.0;            ///< a jump to another branch is that many of them long,
  int jumps = 20;                 ///< and so many of them make a history
};

/// (U, W) integrated together by a stiffly accurate, L-stable scheme of second order: stages W_s = B_s + c r(U_s, W_s)
/// are solved by Newton's method on (U, W) at once with U eliminated by the factorised Jacobian, one factorisation per
/// iteration,
///   dU = -J^-1 (f + J_W dW), (I - c R) dW = -(g - c r_U J^-1 f), g = W - B - c r, R = dr/dW along f = 0,
/// over the nodes that wear. Steps grow while the local error permits; one that does not converge is cut. Where none
/// converges however short, as at a fold, one explicit jump goes to the state that the joint has there. No node loses
/// depth, and none is worn past the load that wears it.
[[nodiscard]] std::unique_ptr<Integrator> implicit_steps(WearingJoint& joint, const HistoryOptions& options,
                                                         steady::State first, const StepMemory& memory,
                                                         const ImplicitParams& params = {});

}  // namespace dovetail::wear
