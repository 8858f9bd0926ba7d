#pragma once

#include <Eigen/Core>
#include <memory>

#include "wear/history/history.hpp"
#include "wear/history/wear_point.hpp"
#include "wear/params.hpp"
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
  /// The same no more exact than steps are, from which a resumed history goes on as if never stopped.
  [[nodiscard]] virtual steady::State as_stepped(const Course& course) const { return state(course); }
};

/// Cycle jumps of constant largest increment: with the rate dW of the state at W, N += dN, W += dN dW,
/// dN = increment / max dW [Salles 2009, eq. 20-22], each from U + dU, dU = -J^-1 J_W dW with the last factorisation
/// (eq. 33-35). A jump whose state does not converge is halved; with `tolerance` jumps are shortened to their local
/// error besides.
///
/// - `first`: the state that the history begins or goes on with
[[nodiscard]] std::unique_ptr<Integrator> explicit_jumps(WearingJoint& joint, const HistoryOptions& options,
                                                         steady::State first, const ExplicitParams& params = {});

/// (U, W) integrated together by a stiffly accurate, L-stable scheme of second order: stages W_s = B_s + c r(U_s, W_s)
/// are solved by Newton's method on (U, W) at once with W eliminated node by node (coupled_point.hpp), by chord steps
/// and products with the factors in use as long as these serve. Steps grow while the local error permits; one that does
/// not converge is cut. Where none converges however short, as at a fold, one explicit jump goes to the state that the
/// joint has there. No node loses depth, and none is worn past the load that wears it.
[[nodiscard]] std::unique_ptr<Integrator> implicit_steps(WearingJoint& joint, const HistoryOptions& options,
                                                         steady::State first, const StepMemory& memory,
                                                         const ImplicitParams& params = {});

}  // namespace dovetail::wear
