#include "tractions/slip_origin_sensitivity.hpp"

#include <cassert>

#include "dynamics/extremes.hpp"
#include "dynamics/real_block.hpp"

namespace dovetail::tractions {
namespace {

// dq/dX_T = -(df/dX_T)^T J^-T dq/dU with df/dX_T = -eps in the mean rows.
Eigen::MatrixXd by_adjoint(const steady::Tangent& tangent, const Eigen::MatrixXd& gradient) {
  const steady::Problem& problem = tangent.problem();
  const Eigen::Index nodes = problem.model().nodes(), d = problem.model().directions();
  const Eigen::VectorXd adjoint = tangent.solve_transposed(gradient.reshaped(gradient.size(), 1)).col(0);
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(nodes, d - 1);
  for (Eigen::Index i = 0; i < nodes; ++i)
    if (tangent.point().nodes[static_cast<std::size_t>(i)].always_stuck)
      for (Eigen::Index r = 1; r < d; ++r) result(i, r - 1) = problem.dof_penalty()(i * d + r) * adjoint(i * d + r);
  return result;
}

}  // namespace

Eigen::MatrixXd amplitude_to_slip_origin(const steady::State& state, Eigen::Index output) {
  assert(state.tangent);
  const steady::Tangent& tangent = *state.tangent;
  const steady::Problem& problem = tangent.problem();
  const dynamics::Extremes found = dynamics::extremes(state.outputs.row(output).transpose());
  const Eigen::Index k = problem.basis().coefficients();
  const Eigen::VectorXd weight =
      (dynamics::fourier_row(found.tau_maximum, k) - dynamics::fourier_row(found.tau_minimum, k)) / 2;
  Eigen::MatrixXd gradient = Eigen::MatrixXd::Zero(problem.model().contact_size(), k);
  for (std::size_t h = 1; h < problem.system().harmonics.size(); ++h) {
    const auto j = static_cast<Eigen::Index>(h);
    const Eigen::MatrixXcd shape = problem.model().output_gradient(problem.system().harmonics[h]);
    const Eigen::VectorXd real = shape.row(output).real(), imaginary = shape.row(output).imag();
    gradient.col(2 * j - 1) = weight(2 * j - 1) * real - weight(2 * j) * imaginary;
    gradient.col(2 * j) = weight(2 * j - 1) * imaginary + weight(2 * j) * real;
  }
  return by_adjoint(tangent, gradient);
}

Eigen::MatrixXd slip_to_slip_origin(const steady::State& state, const SlipWeights& weights) {
  assert(state.tangent);
  const steady::Tangent& tangent = *state.tangent;
  const steady::Problem& problem = tangent.problem();
  const Eigen::Index d = problem.model().directions(), k = problem.basis().coefficients();
  Eigen::MatrixXd by_prediction(problem.model().contact_size(), k);
  for (Eigen::Index i = 0; i < problem.model().nodes(); ++i) {
    const contact::MarchResult& node = tangent.point().nodes[static_cast<std::size_t>(i)];
    by_prediction.middleRows(i * d, d) =
        (weights.load(i) * node.slip_load_derivative + weights.energy(i) * node.dissipation_derivative).reshaped(d, k);
  }
  // d lambda_u = (eps I - Z) dU; the transpose of the real form of a complex symmetric Z is that of its conjugate.
  const Eigen::VectorXd by_stiffness = problem.system().stiffness.apply(by_prediction.reshaped(), true);
  const Eigen::MatrixXd gradient =
      problem.dof_penalty().asDiagonal() * by_prediction - by_stiffness.reshaped(by_prediction.rows(), k);
  return by_adjoint(tangent, gradient);
}

Eigen::MatrixXd response_to_slip_origin(const steady::State& state, const Eigen::MatrixXd& change) {
  assert(state.tangent);
  const steady::Tangent& tangent = *state.tangent;
  const steady::Problem& problem = tangent.problem();
  const Eigen::Index nodes = problem.model().nodes(), d = problem.model().directions();
  Eigen::MatrixXd rhs = Eigen::MatrixXd::Zero(problem.unknowns(), 1);
  for (Eigen::Index i = 0; i < nodes; ++i)
    if (tangent.point().nodes[static_cast<std::size_t>(i)].always_stuck)
      for (Eigen::Index r = 1; r < d; ++r) rhs(i * d + r, 0) = problem.dof_penalty()(i * d + r) * change(i, r - 1);
  const Eigen::MatrixXd solved = tangent.solve(rhs);
  return solved.reshaped(nodes * d, problem.basis().coefficients());
}

}  // namespace dovetail::tractions
