#include "response/slip_origin_sensitivity.hpp"

#include <cassert>

#include "response/amplitude.hpp"
#include "response/real_block.hpp"

namespace dovetail::response {
namespace {

// dq/dX_T = -(df/dX_T)^T J^-T dq/dU with df/dX_T = -eps in the mean rows.
Eigen::MatrixXd by_adjoint(const Linearisation& linear, const Eigen::MatrixXd& gradient) {
  const SteadyResidual& residual = linear.residual();
  const Eigen::Index nodes = residual.model().nodes(), d = residual.model().directions();
  const Eigen::VectorXd adjoint = linear.solve_transposed(gradient.reshaped(gradient.size(), 1)).col(0);
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(nodes, d - 1);
  for (Eigen::Index i = 0; i < nodes; ++i)
    if (linear.state().nodes[static_cast<std::size_t>(i)].always_stuck)
      for (Eigen::Index r = 1; r < d; ++r) result(i, r - 1) = residual.penalty_of(i * d + r) * adjoint(i * d + r);
  return result;
}

}  // namespace

Eigen::MatrixXd amplitude_to_slip_origin(const SteadyState& state, Eigen::Index output) {
  assert(state.linearisation);
  const Linearisation& linear = *state.linearisation;
  const SteadyResidual& residual = linear.residual();
  const Extremes found = extremes(state.outputs.row(output).transpose());
  const Eigen::Index k = residual.basis().coefficients();
  const Eigen::VectorXd weight = (fourier_row(found.tau_maximum, k) - fourier_row(found.tau_minimum, k)) / 2;
  Eigen::MatrixXd gradient = Eigen::MatrixXd::Zero(residual.model().contact_size(), k);
  for (std::size_t h = 1; h < residual.system().harmonics.size(); ++h) {
    const auto j = static_cast<Eigen::Index>(h);
    const Eigen::MatrixXcd shape = residual.model().output_gradient(residual.system().harmonics[h]);
    const Eigen::VectorXd real = shape.row(output).real(), imaginary = shape.row(output).imag();
    gradient.col(2 * j - 1) = weight(2 * j - 1) * real - weight(2 * j) * imaginary;
    gradient.col(2 * j) = weight(2 * j - 1) * imaginary + weight(2 * j) * real;
  }
  return by_adjoint(linear, gradient);
}

Eigen::MatrixXd slip_load_to_slip_origin(const SteadyState& state, const Eigen::VectorXd& weights) {
  assert(state.linearisation);
  const Linearisation& linear = *state.linearisation;
  const SteadyResidual& residual = linear.residual();
  const Eigen::Index d = residual.model().directions(), k = residual.basis().coefficients();
  Eigen::MatrixXd by_prediction(residual.model().contact_size(), k);
  for (Eigen::Index i = 0; i < residual.model().nodes(); ++i)
    by_prediction.middleRows(i * d, d) =
        weights(i) * linear.state().nodes[static_cast<std::size_t>(i)].slip_load_derivative.reshaped(d, k);
  // d lambda_u = (eps I - Z) dU; the transpose of the real form of a complex symmetric Z is that of its conjugate.
  Eigen::MatrixXd gradient(by_prediction.rows(), k);
  for (std::size_t h = 0; h < residual.system().harmonics.size(); ++h) {
    const auto j = static_cast<Eigen::Index>(h);
    put_harmonic(-residual.system().harmonics[h].stiffness.conjugate() * harmonic_of(by_prediction, j), j, gradient);
  }
  for (Eigen::Index a = 0; a < gradient.rows(); ++a) gradient.row(a) += residual.penalty_of(a) * by_prediction.row(a);
  return by_adjoint(linear, gradient);
}

Eigen::MatrixXd response_to_slip_origin(const SteadyState& state, const Eigen::MatrixXd& change) {
  assert(state.linearisation);
  const Linearisation& linear = *state.linearisation;
  const SteadyResidual& residual = linear.residual();
  const Eigen::Index nodes = residual.model().nodes(), d = residual.model().directions();
  Eigen::MatrixXd rhs = Eigen::MatrixXd::Zero(residual.unknowns(), 1);
  for (Eigen::Index i = 0; i < nodes; ++i)
    if (linear.state().nodes[static_cast<std::size_t>(i)].always_stuck)
      for (Eigen::Index r = 1; r < d; ++r) rhs(i * d + r, 0) = residual.penalty_of(i * d + r) * change(i, r - 1);
  const Eigen::MatrixXd solved = linear.solve(rhs);
  return solved.reshaped(nodes * d, residual.basis().coefficients());
}

}  // namespace dovetail::response
