#include "steady/factored_jacobian.hpp"

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

FactoredJacobian::FactoredJacobian(std::shared_ptr<const Point> point, const FactoredJacobian* near)
    : point_(std::move(point)) {
  assert(point_->has_derivative);
  factorise(0, near);
  // A body that floats in a trial state has no Jacobian to solve with: lean it slightly on its contact.
  if (separated_->status() != Status::converged || lu_.status() == Status::singular ||
      nearly_singular(SingularityParams{}.singular))
    factorise(SingularityParams{}.regularised, nullptr);
}

bool FactoredJacobian::nearly_singular(double limit) const {
  if (separated_->reciprocal_condition() < limit) return true;
  return lu_.pivot_ratio() < SingularityParams{}.safe_pivots && lu_.reciprocal_condition() < limit;
}

double FactoredJacobian::product_operations() const {
  const auto dense = static_cast<double>(size());
  return steady::product_operations(dense * dense + point_->problem->system().stiffness.entries());
}

bool FactoredJacobian::serve(const Problem& other) const {
  return status() == Status::converged && !regularised() && point_->problem->unknowns() == other.unknowns() &&
         point_->problem->penalty() == other.penalty();
}

bool FactoredJacobian::belong_to(const Point& other) const {
  if (!serve(*other.problem) || point_->problem->shared_system() != other.problem->shared_system()) return false;
  for (std::size_t i = 0; i < point_->nodes.size(); ++i) {
    const Eigen::MatrixXd &here = point_->nodes[i].force_derivative, &there = other.nodes[i].force_derivative;
    if ((here - there).cwiseAbs().maxCoeff() > SingularityParams{}.same) return false;
  }
  return true;
}

JacobianBlocks FactoredJacobian::kept_blocks() const {
  JacobianBlocks blocks;
  blocks.stiffness = &separated_->stiffness();
  for (const Eigen::Index i : nodes_)
    blocks.derivative.push_back(&point_->nodes[static_cast<std::size_t>(i)].force_derivative);
  blocks.penalty.resize(static_cast<Eigen::Index>(separated_->kept().size()));
  for (Eigen::Index a = 0; a < blocks.penalty.size(); ++a)
    blocks.penalty(a) = point_->problem->dof_penalty()(separated_->kept()[static_cast<std::size_t>(a)]);
  return blocks;
}

void FactoredJacobian::factorise(double regularisation, const FactoredJacobian* near) {
  const Problem& of = *point_->problem;
  const Eigen::Index d = of.model().directions(), k = of.basis().coefficients();
  regularisation_ = regularisation;
  std::vector<Eigen::Index> open, kept;
  nodes_.clear();
  for (Eigen::Index i = 0; i < of.model().nodes(); ++i) {
    const bool separated = regularisation == 0 && point_->nodes[static_cast<std::size_t>(i)].always_separated;
    if (!separated) nodes_.push_back(i);
    for (Eigen::Index r = 0; r < d; ++r) (separated ? open : kept).push_back(i * d + r);
  }
  const bool lent = near != nullptr && near->separated_->are(of.system(), open);
  separated_ = lent ? near->separated_
                    : std::make_shared<const SeparatedNodes>(of.shared_system(), std::move(open), std::move(kept));
  if (separated_->status() != Status::converged) return;
  const JacobianBlocks blocks = kept_blocks();
  active_.clear();
  direct_.clear();
  std::vector<double> diagonal;
  for (Eigen::Index i = 0; i < static_cast<Eigen::Index>(nodes_.size()); ++i)
    for (Eigen::Index l = 0; l < d * k; ++l) {
      const Eigen::Index dof = i * d + l % d, unknown = (l / d) * blocks.size() + dof;
      if (is_identity_row(*blocks.derivative[static_cast<std::size_t>(i)], l)) {
        direct_.push_back(unknown);
        diagonal.push_back(blocks.penalty(dof));
      } else {
        active_.push_back(unknown);
      }
    }
  direct_diagonal_ = Eigen::Map<Eigen::VectorXd>(diagonal.data(), static_cast<Eigen::Index>(diagonal.size()));
  const auto active = static_cast<Eigen::Index>(active_.size());
  Eigen::MatrixXd matrix(active, active);
  std::vector<double*> columns(static_cast<std::size_t>(blocks.size() * k), nullptr);
  for (Eigen::Index j = 0; j < active; ++j)
    columns[static_cast<std::size_t>(active_[static_cast<std::size_t>(j)])] = matrix.col(j).data();
  assemble(blocks, active_, columns, regularisation);
  operations_ = factorisation_operations(active) + (lent ? 0 : separated_->operations());
  if (of.budget()) of.budget()->spend_on_factors(operations_);
  lu_.factorise(std::move(matrix));
}

Eigen::MatrixXd FactoredJacobian::solve(const Eigen::MatrixXd& rhs) const {
  const JacobianBlocks blocks = kept_blocks();
  const Eigen::MatrixXd on_open = separated_->part_of(separated_->open(), rhs);
  Eigen::MatrixXd kept = separated_->part_of(separated_->kept(), rhs);
  if (on_open.rows() > 0) {
    const Eigen::MatrixXd pushed = separated_->apply_shape(dynamics::Form::transposed, on_open);
    kept -= pushed - apply_derivative(blocks, pushed, false);
  }
  Eigen::MatrixXd solution = Eigen::MatrixXd::Zero(kept.rows(), kept.cols());
  if (!direct_.empty()) {
    solution(direct_, Eigen::all) =
        direct_diagonal_.cwiseInverse().asDiagonal() * Eigen::MatrixXd(kept(direct_, Eigen::all));
    if (!active_.empty()) kept -= (1 - regularisation_) * apply_jacobian(blocks, solution);
  }
  solution(active_, Eigen::all) = lu_.solve(kept(active_, Eigen::all));
  if (on_open.rows() == 0) return solution;
  Eigen::MatrixXd result(rhs.rows(), rhs.cols());
  separated_->put_part(separated_->kept(), solution, result);
  separated_->put_part(
      separated_->open(),
      separated_->solve_open(on_open, false) - separated_->apply_shape(dynamics::Form::plain, solution), result);
  return result;
}

Eigen::MatrixXd FactoredJacobian::solve_transposed(const Eigen::MatrixXd& rhs) const {
  const JacobianBlocks blocks = kept_blocks();
  const Eigen::MatrixXd on_open = separated_->part_of(separated_->open(), rhs);
  Eigen::MatrixXd kept = separated_->part_of(separated_->kept(), rhs);
  if (on_open.rows() > 0) kept -= separated_->apply_shape(dynamics::Form::adjoint, on_open);
  Eigen::MatrixXd solution = Eigen::MatrixXd::Zero(kept.rows(), kept.cols());
  solution(active_, Eigen::all) = lu_.solve_transposed(kept(active_, Eigen::all));
  if (!direct_.empty()) {
    if (!active_.empty()) kept -= (1 - regularisation_) * apply_jacobian_transposed(blocks, solution);
    solution(direct_, Eigen::all) =
        direct_diagonal_.cwiseInverse().asDiagonal() * Eigen::MatrixXd(kept(direct_, Eigen::all));
  }
  if (on_open.rows() == 0) return solution;
  Eigen::MatrixXd result(rhs.rows(), rhs.cols());
  separated_->put_part(separated_->kept(), solution, result);
  const Eigen::MatrixXd complement = solution - apply_derivative(blocks, solution, true);
  separated_->put_part(
      separated_->open(),
      separated_->solve_open(on_open, true) - separated_->apply_shape(dynamics::Form::conjugated, complement), result);
  return result;
}

}  // namespace dovetail::steady
