#include "wear/history/implicit_step.hpp"

#include <utility>

namespace dovetail::wear {

using Eigen::Index;
using Eigen::VectorXd;

namespace {

// gamma of the L-stable, stiffly accurate scheme of two stages and second order [Alexander 1977].
constexpr double kGamma = 0.29289321881345254;

/// Third-order quadrature over the rates at the start, at gamma and at the end, minus that of the scheme: the embedded
/// estimate of the local error [Hosea & Shampine 1996].
struct ErrorWeights {
  double start = 0.5 - 1.0 / (6.0 * kGamma);
  double middle = 1.0 / (6.0 * kGamma * (1.0 - kGamma)) - (1.0 - kGamma);
  double end = 0.5 - 1.0 / (6.0 * (1.0 - kGamma)) - kGamma;
};

}  // namespace

Status implicit_step(ImplicitStage& stage, double jump, int iterations, WearPoint& point, VectorXd& error) {
  const Index nodes = point.depth.size();
  const VectorXd cycles = VectorXd::Constant(nodes, kGamma * jump);
  const WearPoint start = point;
  WearPoint middle = start;
  if (const Status status = stage.solve(start.depth, cycles, iterations, middle); status != Status::converged)
    return status;
  const VectorXd base = start.depth + (1.0 - kGamma) * jump * middle.rate;
  WearPoint end = middle;
  if (const Status status = stage.solve(base, cycles, iterations, end); status != Status::converged) return status;
  // The explicit half of the scheme takes a node past the depth at which it carries or slips no more: from there on it
  // wears by the implicit rule from the first stage.
  VectorXd bounded = base;
  VectorXd slowed = cycles;
  bool past = false;
  for (Index i = 0; i < nodes; ++i)
    if (end.rate[i] <= 0.0 && base[i] > middle.depth[i]) {
      bounded[i] = middle.depth[i];
      slowed[i] = (1.0 - kGamma) * jump;
      past = true;
    }
  if (past) {
    if (const Status status = stage.solve(bounded, slowed, iterations, end); status != Status::converged) return status;
  }
  constexpr ErrorWeights kWeights;
  error = stage.damp(slowed,
                     jump * (kWeights.start * start.rate + kWeights.middle * middle.rate + kWeights.end * end.rate));
  point = std::move(end);
  return Status::converged;
}

}  // namespace dovetail::wear
