#pragma once

#include <Eigen/Core>
#include <memory>
#include <string>

#include "core/options.hpp"
#include "steady/state.hpp"
#include "tractions/bounded_quantity.hpp"

namespace dovetail::tractions {

struct TractionBoundsOptions {
  int output = 0;           ///< of the amplitudes, [0, n_out)
  int max_solves = 1000;    ///< steady states in all, >= 2
  double tolerance = 1e-8;  ///< relative gain below which the search ends, > 0
};

/// One attained value and the state it belongs to.
struct AttainedValue {
  double value = 0;
  double omega = 0;             ///< rad/s
  Eigen::MatrixXd slip_origin;  ///< X_T [Nc, d-1] that gives it, m: pass it on as steady::Condition::slip_origin
  Eigen::MatrixXd traction;     ///< m = mean lambda_T / (mu mean lambda_N) there [Nc, d-1]; 0 where nothing is carried
};

/// Bounds of a response over the residual tractions of the nodes that stay stuck. They are *attained* values: the true
/// range contains [minimum, maximum], and is larger when a climb ended in a local extreme.
struct TractionBounds {
  Status status = Status::iteration_limit;  ///< converged; iteration_limit: max_solves ended the search; or of nominal
  std::string reason;                       ///< one sentence, never empty
  AttainedValue nominal;                    ///< at the slip origin given
  AttainedValue minimum, maximum;           ///< smallest and largest value found, nominal included
  int stuck_nodes = 0;                      ///< that stayed stuck in the nominal state: only their tractions are free
  int solves = 0;                           ///< steady states asked for
  int failed = 0;                           ///< of them, not converged: they count for nothing
};

/// Nodes that stay stuck all the period keep the tractions their history left them, |m| <= 1 of mu lambda_N: the
/// response is a family with the slip origins X_T as its parameters. This searches it for the smallest and largest
/// value of one quantity: along exact gradients from many starts, then without them, which kinks need; where other
/// nodes stick than in the given state, it goes on with those. Each value belongs to a steady state solved from a slip
/// origin: a node whose traction does not fit slips in the march until it does, so every member is admissible. Residual
/// tractions only matter where they change normal forces; otherwise they shift means, and minimum and maximum agree.
///
/// Without stuck nodes in the given state there is nothing to search from: minimum, maximum and nominal are equal.
/// `omega` rad/s. `guess` is U of a nearby state or empty.
[[nodiscard]] TractionBounds traction_bounds(const steady::Joint& joint, double omega, BoundedQuantity quantity,
                                             const TractionBoundsOptions& bounds = {},
                                             const Eigen::MatrixXd& guess = {});

}  // namespace dovetail::tractions

namespace dovetail {
template <>
std::span<const Field<tractions::TractionBoundsOptions>> option_table<tractions::TractionBoundsOptions>();
}
