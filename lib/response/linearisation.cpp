#include "response/linearisation.hpp"

#include <cassert>

namespace dovetail::response {
namespace {

// Row `l` of D is the row of the identity: the force follows its own prediction and nothing else.
bool is_identity_row(const Eigen::MatrixXd& derivative, Eigen::Index l) {
  for (Eigen::Index j = 0; j < derivative.cols(); ++j)
    if (derivative(l, j) != (j == l ? 1.0 : 0.0)) return false;
  return true;
}

}  // namespace

Linearisation::Linearisation(SteadyResidual residual, ResidualState state)
    : residual_(std::move(residual)), state_(std::move(state)) {
  assert(state_.has_derivative);
  const Eigen::Index nc = residual_.model().contact_size(), d = residual_.model().directions();
  const Eigen::Index k = residual_.basis().coefficients();
  std::vector<double> diagonal;
  for (Eigen::Index i = 0; i < residual_.model().nodes(); ++i) {
    const Eigen::MatrixXd& derivative = state_.nodes[static_cast<std::size_t>(i)].force_derivative;
    for (Eigen::Index l = 0; l < d * k; ++l) {
      const Eigen::Index dof = i * d + l % d, unknown = (l / d) * nc + dof;
      if (is_identity_row(derivative, l)) {
        direct_.push_back(unknown);
        diagonal.push_back(residual_.penalty_of(dof));
      } else {
        active_.push_back(unknown);
      }
    }
  }
  direct_diagonal_ = Eigen::Map<Eigen::VectorXd>(diagonal.data(), static_cast<Eigen::Index>(diagonal.size()));
  factorise(0);
  // A body that floats in a trial state has no Jacobian to solve with: lean it slightly on its contact.
  if (lu_.status() == Status::singular || lu_.reciprocal_condition() < 1e-15) {
    regularised_ = true;
    factorise(1e-6);
  }
}

void Linearisation::factorise(double regularisation) {
  const auto active = static_cast<Eigen::Index>(active_.size()), direct = static_cast<Eigen::Index>(direct_.size());
  Eigen::MatrixXd matrix(active, active);
  coupling_.resize(active, direct);
  std::vector<double*> columns(static_cast<std::size_t>(unknowns()), nullptr);
  for (Eigen::Index j = 0; j < active; ++j)
    columns[static_cast<std::size_t>(active_[static_cast<std::size_t>(j)])] = matrix.col(j).data();
  for (Eigen::Index j = 0; j < direct; ++j)
    columns[static_cast<std::size_t>(direct_[static_cast<std::size_t>(j)])] = coupling_.col(j).data();
  residual_.assemble(state_, active_, columns, regularisation);
  lu_.factorise(std::move(matrix));
}

Eigen::Index Linearisation::unknowns() const {
  return residual_.unknowns();
}

Eigen::MatrixXd Linearisation::solve(const Eigen::Ref<const Eigen::MatrixXd>& rhs) const {
  Eigen::MatrixXd solution(rhs.rows(), rhs.cols());
  const Eigen::MatrixXd direct =
      direct_diagonal_.cwiseInverse().asDiagonal() * Eigen::MatrixXd(rhs(direct_, Eigen::all));
  Eigen::MatrixXd rest = rhs(active_, Eigen::all);
  rest.noalias() -= coupling_ * direct;
  solution(direct_, Eigen::all) = direct;
  solution(active_, Eigen::all) = lu_.solve(std::move(rest));
  return solution;
}

Eigen::MatrixXd Linearisation::solve_transposed(const Eigen::Ref<const Eigen::MatrixXd>& rhs) const {
  Eigen::MatrixXd solution(rhs.rows(), rhs.cols());
  const Eigen::MatrixXd active = lu_.solve_transposed(rhs(active_, Eigen::all));
  Eigen::MatrixXd direct = rhs(direct_, Eigen::all);
  direct.noalias() -= coupling_.transpose() * active;
  solution(active_, Eigen::all) = active;
  solution(direct_, Eigen::all) = direct_diagonal_.cwiseInverse().asDiagonal() * direct;
  return solution;
}

Eigen::MatrixXd Linearisation::residual_to_wear(const std::vector<Eigen::Index>& nodes) const {
  const Eigen::Index nc = residual_.model().contact_size(), d = residual_.model().directions();
  const Eigen::Index k = residual_.basis().coefficients();
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(unknowns(), static_cast<Eigen::Index>(nodes.size()));
  for (std::size_t p = 0; p < nodes.size(); ++p) {
    const Eigen::Index i = nodes[p];
    const Eigen::VectorXd column =
        -residual_.penalty().normal(i) * state_.nodes[static_cast<std::size_t>(i)].force_derivative.col(0);
    for (Eigen::Index l = 0; l < d * k; ++l)
      result((l / d) * nc + i * d + l % d, static_cast<Eigen::Index>(p)) = column(l);
  }
  return result;
}

Eigen::MatrixXd Linearisation::response_to_wear(const Eigen::VectorXd& wear_change) const {
  const Eigen::Index nc = residual_.model().contact_size();
  std::vector<Eigen::Index> nodes;
  std::vector<double> change;
  for (Eigen::Index i = 0; i < wear_change.size(); ++i)
    if (wear_change(i) != 0) {
      nodes.push_back(i);
      change.push_back(wear_change(i));
    }
  const Eigen::VectorXd by_wear =
      residual_to_wear(nodes) *
      Eigen::Map<const Eigen::VectorXd>(change.data(), static_cast<Eigen::Index>(change.size()));
  const Eigen::VectorXd solved = solve(-by_wear);
  return solved.reshaped(nc, residual_.basis().coefficients());
}

Eigen::MatrixXd Linearisation::response_to_frequency() const {
  const Eigen::Index nc = residual_.model().contact_size();
  // lambda_u falls by what the linear part gains, and lambda follows it through D.
  const Eigen::MatrixXd linear = residual_slope_linear(residual_.system(), state_.displacement);
  const Eigen::MatrixXd slope = linear - residual_.apply_force_derivative(state_, linear);
  const Eigen::VectorXd solved = solve(-slope.reshaped());
  return solved.reshaped(nc, residual_.basis().coefficients());
}

Eigen::VectorXd Linearisation::wear_rate_change(const Eigen::MatrixXd& response_change,
                                                const Eigen::VectorXd& wear_change) const {
  const CondensedModel& model = residual_.model();
  const Eigen::Index d = model.directions();
  Eigen::MatrixXd change = -apply_stiffness(residual_.system(), response_change);
  for (Eigen::Index a = 0; a < change.rows(); ++a) change.row(a) += residual_.penalty_of(a) * response_change.row(a);
  Eigen::VectorXd rate(model.nodes());
  for (Eigen::Index i = 0; i < model.nodes(); ++i) {
    if (wear_change.size() > 0) change(i * d, 0) -= residual_.penalty().normal(i) * wear_change(i);
    const Eigen::MatrixXd block = change.middleRows(i * d, d);
    rate(i) = model.contact().wear_coefficient(i) / model.contact().area(i) *
              state_.nodes[static_cast<std::size_t>(i)].slip_load_derivative.dot(block.reshaped());
  }
  return rate;
}

Eigen::MatrixXd Linearisation::wear_rate_to_wear(const std::vector<Eigen::Index>& nodes) const {
  const Eigen::Index nc = residual_.model().contact_size(), k = residual_.basis().coefficients();
  const Eigen::MatrixXd responses = solve(-residual_to_wear(nodes));
  Eigen::MatrixXd result(residual_.model().nodes(), static_cast<Eigen::Index>(nodes.size()));
  for (std::size_t p = 0; p < nodes.size(); ++p) {
    Eigen::VectorXd unit = Eigen::VectorXd::Zero(residual_.model().nodes());
    unit(nodes[p]) = 1;
    const auto column = static_cast<Eigen::Index>(p);
    const Eigen::MatrixXd response = responses.col(column).reshaped(nc, k);
    result.col(column) = wear_rate_change(response, unit);
  }
  return result;
}

}  // namespace dovetail::response
