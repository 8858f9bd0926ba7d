#include "steady/tangent.hpp"

#include <cassert>
#include <cmath>

#include "steady/params.hpp"
#include "steady/work.hpp"

namespace dovetail::steady {
namespace {

// Row `l` of D is the row of the identity, to rounding: the force follows its own prediction and nothing else. So is
// every harmonic of a node that slid in earlier periods only, but for what the Fourier sums of a constant leave.
bool is_identity_row(const Eigen::MatrixXd& derivative, Eigen::Index l) {
  for (Eigen::Index j = 0; j < derivative.cols(); ++j)
    if (!(std::abs(derivative(l, j) - (j == l ? 1.0 : 0.0)) <= SingularityParams{}.same)) return false;
  return true;
}

}  // namespace

Tangent::Tangent(std::shared_ptr<const Point> point, const Tangent* previous) : point_(std::move(point)) {
  assert(point_->has_derivative);
  if (previous && same_jacobian(*previous)) {
    factors_ = previous->factors_;
    shares_factors_ = true;
    return;
  }
  factors_ = factorise(0);
  // A body that floats in a trial state has no Jacobian to solve with: lean it slightly on its contact.
  if (factors_->separated.status() != Status::converged || factors_->lu.status() == Status::singular ||
      nearly_singular(SingularityParams{}.singular))
    factors_ = factorise(SingularityParams{}.regularised);
}

bool Tangent::nearly_singular(double limit) const {
  if (factors_->separated.reciprocal_condition() < limit) return true;
  return factors_->lu.pivot_ratio() < SingularityParams{}.safe_pivots && factors_->lu.reciprocal_condition() < limit;
}

bool Tangent::same_jacobian(const Tangent& other) const {
  if (other.status() != Status::converged || other.regularised()) return false;
  if (problem().shared_system() != other.problem().shared_system()) return false;
  if (!(problem().penalty() == other.problem().penalty())) return false;
  for (std::size_t i = 0; i < point_->nodes.size(); ++i) {
    const Eigen::MatrixXd &here = point_->nodes[i].force_derivative, &there = other.point_->nodes[i].force_derivative;
    if ((here - there).cwiseAbs().maxCoeff() > SingularityParams{}.same) return false;
  }
  return true;
}

JacobianBlocks Tangent::kept_blocks(const Factors& factors) const {
  JacobianBlocks blocks;
  blocks.stiffness = factors.separated.stiffness();
  for (const Eigen::Index i : factors.nodes)
    blocks.derivative.push_back(&point_->nodes[static_cast<std::size_t>(i)].force_derivative);
  blocks.penalty.resize(static_cast<Eigen::Index>(factors.separated.kept().size()));
  for (Eigen::Index a = 0; a < blocks.penalty.size(); ++a)
    blocks.penalty(a) = problem().dof_penalty()(factors.separated.kept()[static_cast<std::size_t>(a)]);
  return blocks;
}

std::shared_ptr<const Tangent::Factors> Tangent::factorise(double regularisation) const {
  const Eigen::Index d = problem().model().directions(), k = problem().basis().coefficients();
  std::vector<Eigen::Index> open, kept, nodes;
  for (Eigen::Index i = 0; i < problem().model().nodes(); ++i) {
    const bool separated = regularisation == 0 && point_->nodes[static_cast<std::size_t>(i)].always_separated;
    if (!separated) nodes.push_back(i);
    for (Eigen::Index r = 0; r < d; ++r) (separated ? open : kept).push_back(i * d + r);
  }
  auto factors = std::make_shared<Factors>(
      Factors{.separated = SeparatedNodes(problem().shared_system(), std::move(open), std::move(kept)),
              .nodes = std::move(nodes),
              .active = {},
              .direct = {},
              .direct_diagonal = {},
              .regularisation = regularisation,
              .lu = {}});
  if (factors->separated.status() != Status::converged) return factors;
  const JacobianBlocks blocks = kept_blocks(*factors);
  std::vector<double> diagonal;
  for (Eigen::Index i = 0; i < static_cast<Eigen::Index>(factors->nodes.size()); ++i)
    for (Eigen::Index l = 0; l < d * k; ++l) {
      const Eigen::Index dof = i * d + l % d, unknown = (l / d) * blocks.size() + dof;
      if (is_identity_row(*blocks.derivative[static_cast<std::size_t>(i)], l)) {
        factors->direct.push_back(unknown);
        diagonal.push_back(blocks.penalty(dof));
      } else {
        factors->active.push_back(unknown);
      }
    }
  factors->direct_diagonal = Eigen::Map<Eigen::VectorXd>(diagonal.data(), static_cast<Eigen::Index>(diagonal.size()));
  const auto active = static_cast<Eigen::Index>(factors->active.size());
  Eigen::MatrixXd matrix(active, active);
  std::vector<double*> columns(static_cast<std::size_t>(blocks.size() * k), nullptr);
  for (Eigen::Index j = 0; j < active; ++j)
    columns[static_cast<std::size_t>(factors->active[static_cast<std::size_t>(j)])] = matrix.col(j).data();
  assemble(blocks, factors->active, columns, regularisation);
  if (problem().budget()) problem().budget()->spend_on_factors(factorisation_operations(active));
  factors->lu.factorise(std::move(matrix));
  return factors;
}

Eigen::MatrixXd Tangent::solve(const Eigen::Ref<const Eigen::MatrixXd>& rhs) const {
  const Factors& f = *factors_;
  const JacobianBlocks blocks = kept_blocks(f);
  const Eigen::MatrixXd all = rhs, on_open = f.separated.part_of(f.separated.open(), all);
  Eigen::MatrixXd kept = f.separated.part_of(f.separated.kept(), all);
  if (on_open.rows() > 0) {
    const Eigen::MatrixXd pushed = f.separated.apply_shape(dynamics::Form::transposed, on_open);
    kept -= pushed - apply_derivative(blocks, pushed, false);
  }
  Eigen::MatrixXd solution = Eigen::MatrixXd::Zero(kept.rows(), kept.cols());
  if (!f.direct.empty()) {
    solution(f.direct, Eigen::all) =
        f.direct_diagonal.cwiseInverse().asDiagonal() * Eigen::MatrixXd(kept(f.direct, Eigen::all));
    if (!f.active.empty()) kept -= (1 - f.regularisation) * apply_jacobian(blocks, solution);
  }
  solution(f.active, Eigen::all) = f.lu.solve(kept(f.active, Eigen::all));
  if (on_open.rows() == 0) return solution;
  Eigen::MatrixXd result(rhs.rows(), rhs.cols());
  f.separated.put_part(f.separated.kept(), solution, result);
  f.separated.put_part(
      f.separated.open(),
      f.separated.solve_open(on_open, false) - f.separated.apply_shape(dynamics::Form::plain, solution), result);
  return result;
}

Eigen::MatrixXd Tangent::solve_transposed(const Eigen::Ref<const Eigen::MatrixXd>& rhs) const {
  const Factors& f = *factors_;
  const JacobianBlocks blocks = kept_blocks(f);
  const Eigen::MatrixXd all = rhs, on_open = f.separated.part_of(f.separated.open(), all);
  Eigen::MatrixXd kept = f.separated.part_of(f.separated.kept(), all);
  if (on_open.rows() > 0) kept -= f.separated.apply_shape(dynamics::Form::adjoint, on_open);
  Eigen::MatrixXd solution = Eigen::MatrixXd::Zero(kept.rows(), kept.cols());
  solution(f.active, Eigen::all) = f.lu.solve_transposed(kept(f.active, Eigen::all));
  if (!f.direct.empty()) {
    if (!f.active.empty()) kept -= (1 - f.regularisation) * apply_jacobian_transposed(blocks, solution);
    solution(f.direct, Eigen::all) =
        f.direct_diagonal.cwiseInverse().asDiagonal() * Eigen::MatrixXd(kept(f.direct, Eigen::all));
  }
  if (on_open.rows() == 0) return solution;
  Eigen::MatrixXd result(rhs.rows(), rhs.cols());
  f.separated.put_part(f.separated.kept(), solution, result);
  const Eigen::MatrixXd complement = solution - apply_derivative(blocks, solution, true);
  f.separated.put_part(
      f.separated.open(),
      f.separated.solve_open(on_open, true) - f.separated.apply_shape(dynamics::Form::conjugated, complement), result);
  return result;
}

Eigen::MatrixXd Tangent::residual_to_wear(const std::vector<Eigen::Index>& nodes) const {
  const Eigen::Index nc = problem().model().contact_size(), d = problem().model().directions();
  const Eigen::Index k = problem().basis().coefficients();
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(unknowns(), static_cast<Eigen::Index>(nodes.size()));
  for (std::size_t p = 0; p < nodes.size(); ++p) {
    const Eigen::Index i = nodes[p];
    const Eigen::VectorXd column =
        -problem().penalty().normal(i) * point_->nodes[static_cast<std::size_t>(i)].force_derivative.col(0);
    for (Eigen::Index l = 0; l < d * k; ++l)
      result((l / d) * nc + i * d + l % d, static_cast<Eigen::Index>(p)) = column(l);
  }
  return result;
}

Eigen::MatrixXd Tangent::response_to_wear(const Eigen::VectorXd& wear_change) const {
  const Eigen::Index nc = problem().model().contact_size();
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
  return solved.reshaped(nc, problem().basis().coefficients());
}

Eigen::MatrixXd Tangent::response_to_frequency() const {
  const Eigen::Index nc = problem().model().contact_size();
  const Eigen::VectorXd solved = solve(-residual_to_frequency(*point_).reshaped());
  return solved.reshaped(nc, problem().basis().coefficients());
}

Eigen::VectorXd Tangent::wear_rate_change(const Eigen::MatrixXd& response_change,
                                          const Eigen::VectorXd& wear_change) const {
  const dynamics::CondensedModel& model = problem().model();
  const Eigen::Index d = model.directions();
  Eigen::MatrixXd change = problem().dof_penalty().asDiagonal() * response_change -
                           dynamics::apply_stiffness(problem().system(), response_change);
  Eigen::VectorXd rate(model.nodes());
  for (Eigen::Index i = 0; i < model.nodes(); ++i) {
    if (wear_change.size() > 0) change(i * d, 0) -= problem().penalty().normal(i) * wear_change(i);
    const Eigen::MatrixXd block = change.middleRows(i * d, d);
    const contact::MarchResult& node = point_->nodes[static_cast<std::size_t>(i)];
    const contact::WearRate by = model.wear_rate(i, {.load = node.slip_load, .energy = node.dissipation});
    rate(i) = by.by_load * node.slip_load_derivative.dot(block.reshaped()) +
              by.by_energy * node.dissipation_derivative.dot(block.reshaped());
  }
  return rate;
}

Eigen::MatrixXd Tangent::wear_rate_to_wear(const std::vector<Eigen::Index>& nodes) const {
  const Eigen::Index nc = problem().model().contact_size(), k = problem().basis().coefficients();
  const Eigen::MatrixXd responses = solve(-residual_to_wear(nodes));
  Eigen::MatrixXd result(problem().model().nodes(), static_cast<Eigen::Index>(nodes.size()));
  for (std::size_t p = 0; p < nodes.size(); ++p) {
    Eigen::VectorXd unit = Eigen::VectorXd::Zero(problem().model().nodes());
    unit(nodes[p]) = 1;
    const auto column = static_cast<Eigen::Index>(p);
    const Eigen::MatrixXd response = responses.col(column).reshaped(nc, k);
    result.col(column) = wear_rate_change(response, unit);
  }
  return result;
}

}  // namespace dovetail::steady
