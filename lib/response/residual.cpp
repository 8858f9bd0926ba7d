#include "response/residual.hpp"

#include <cassert>
#include <cmath>
#include <numeric>

#include "numerics/dense_lu.hpp"
#include "response/real_block.hpp"
#include "response/work.hpp"

namespace dovetail::response {

HarmonicSystem harmonic_system(const CondensedModel& model, int harmonics, double omega, double static_scale) {
  HarmonicSystem system;
  system.omega = omega;
  system.force.resize(model.contact_size(), 2 * harmonics + 1);
  for (int h = 0; h <= harmonics; ++h) {
    system.harmonics.push_back(model.harmonic(h, omega, static_scale));
    const HarmonicStiffness& at = system.harmonics.back();
    if (at.status != Status::converged) system.status = at.status;
    if (!at.stiffness.allFinite() || !at.force.allFinite()) system.status = Status::not_finite;
    put_harmonic(at.force, h, system.force);
  }
  system.force_scale = system.force.rightCols(2 * harmonics).norm();
  if (!(system.force_scale > 0)) system.force_scale = system.force.norm();
  if (!(system.force_scale > 0)) system.force_scale = 1;
  return system;
}

Eigen::MatrixXd apply_stiffness(const HarmonicSystem& system, const Eigen::MatrixXd& displacement) {
  Eigen::MatrixXd result(displacement.rows(), displacement.cols());
  result.col(0).noalias() = system.harmonics[0].stiffness.real() * displacement.col(0);
  for (std::size_t h = 1; h < system.harmonics.size(); ++h)
    put_harmonic(system.harmonics[h].stiffness * harmonic_of(displacement, static_cast<Eigen::Index>(h)),
                 static_cast<Eigen::Index>(h), result);
  return result;
}

Eigen::MatrixXd residual_slope_linear(const CondensedModel& model, const HarmonicSystem& system,
                                      const Eigen::MatrixXd& displacement) {
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(displacement.rows(), displacement.cols());
  for (std::size_t h = 1; h < system.harmonics.size(); ++h) {
    const HarmonicStiffness& at = system.harmonics[h];
    const auto j = static_cast<Eigen::Index>(h);
    put_harmonic(model.slope(static_cast<int>(h), system.omega, at, harmonic_of(displacement, j)), j, result);
  }
  return result;
}

SteadyResidual::SteadyResidual(std::shared_ptr<const CondensedModel> model,
                               std::shared_ptr<const HarmonicSystem> system, numerics::FourierBasis basis,
                               contact::PseudoPenalty penalty, ContactCondition condition, contact::MarchOptions march,
                               SharedBudget budget)
    : model_(std::move(model)),
      system_(std::move(system)),
      basis_(std::move(basis)),
      penalty_(std::move(penalty)),
      condition_(std::move(condition)),
      march_(march),
      budget_(std::move(budget)) {
  const Eigen::Index nodes = model_->nodes(), d = model_->directions();
  const auto require = [](bool good, const char* key, Eigen::Index found, Eigen::Index wanted) {
    if (!good)
      throw InputError({.file = {},
                        .key = key,
                        .value = "size " + std::to_string(found),
                        .allowed = "must be empty or have size " + std::to_string(wanted)});
  };
  if (condition_.wear_depth.size() == 0) condition_.wear_depth = Eigen::VectorXd::Zero(nodes);
  if (condition_.released.empty()) condition_.released.assign(static_cast<std::size_t>(nodes), 0);
  if (condition_.slip_origin.size() == 0) condition_.slip_origin = model_->contact().slip_origin;
  require(condition_.wear_depth.size() == nodes, "wear_depth", condition_.wear_depth.size(), nodes);
  require(static_cast<Eigen::Index>(condition_.released.size()) == nodes, "released",
          static_cast<Eigen::Index>(condition_.released.size()), nodes);
  require(condition_.slip_origin.rows() == nodes && condition_.slip_origin.cols() == d - 1, "slip_origin",
          condition_.slip_origin.size(), nodes * (d - 1));
  offset_ = Eigen::VectorXd::Zero(nodes * d);
  dof_penalty_.resize(nodes * d);
  for (Eigen::Index i = 0; i < nodes; ++i) {
    offset_(i * d) = model_->contact().gap(i) + condition_.wear_depth(i);
    dof_penalty_(i * d) = penalty_.normal(i);
    dof_penalty_.segment(i * d + 1, d - 1).setConstant(penalty_.tangential(i));
  }
}

void SteadyResidual::evaluate(const Eigen::MatrixXd& displacement, bool with_derivative, ResidualState& state) const {
  const Eigen::Index nodes = model_->nodes(), d = model_->directions(), k = basis_.coefficients();
  assert(displacement.rows() == nodes * d && displacement.cols() == k);
  state.displacement = displacement;
  state.has_derivative = with_derivative;
  state.status = Status::converged;
  const Eigen::MatrixXd external = system_->force - apply_stiffness(*system_, displacement);
  state.prediction = external + dof_penalty_.asDiagonal() * displacement;
  state.prediction.col(0) -= dof_penalty_.cwiseProduct(offset_);
  const Eigen::MatrixXd samples = basis_.synthesise(state.prediction);
  Eigen::MatrixXd force(samples.rows(), samples.cols());
  state.nodes.resize(static_cast<std::size_t>(nodes));
  if (!samples.allFinite()) {
    state.status = Status::not_finite;
    state.force = state.residual = Eigen::MatrixXd::Constant(nodes * d, k, std::numeric_limits<double>::quiet_NaN());
    return;
  }
  for (Eigen::Index i = 0; i < nodes; ++i) {
    contact::MarchResult& node = state.nodes[static_cast<std::size_t>(i)];
    if (released(i)) {
      contact::carry_nothing(samples.middleCols(i * d, d), penalty_.tangential(i), k, node);
    } else {
      contact::NodeLaw law{.friction = model_->contact().friction(i),
                           .normal_penalty = penalty_.normal(i),
                           .tangential_penalty = penalty_.tangential(i)};
      for (Eigen::Index r = 0; r + 1 < d; ++r) law.slip_origin(r) = condition_.slip_origin(i, r);
      contact::march(samples.middleCols(i * d, d), law, basis_, march_, with_derivative, node);
      if (budget_) budget_->spend(march_operations(basis_.samples(), node.periods, with_derivative ? d * k : 0));
    }
    force.middleCols(i * d, d) = node.force;
    if (node.status != Status::converged) state.status = node.status;
  }
  state.force = basis_.analyse(force);
  state.residual = state.force - external;
}

JacobianBlocks SteadyResidual::blocks(const ResidualState& state) const {
  assert(state.has_derivative);
  JacobianBlocks blocks;
  for (const HarmonicStiffness& at : system_->harmonics) blocks.stiffness.push_back(&at.stiffness);
  for (const contact::MarchResult& node : state.nodes) blocks.derivative.push_back(&node.force_derivative);
  blocks.penalty = dof_penalty_;
  return blocks;
}

Eigen::MatrixXd SteadyResidual::apply_force_derivative(const ResidualState& state,
                                                       const Eigen::MatrixXd& change) const {
  const Eigen::VectorXd applied = apply_derivative(blocks(state), change.reshaped(), false);
  return applied.reshaped(change.rows(), change.cols());
}

namespace {

void assemble_rows(const JacobianBlocks& blocks, const std::vector<Eigen::Index>& rows, Eigen::MatrixXd& into) {
  into.resize(static_cast<Eigen::Index>(rows.size()), blocks.size() * blocks.coefficients());
  std::vector<double*> columns;
  for (Eigen::Index j = 0; j < into.cols(); ++j) columns.push_back(into.col(j).data());
  assemble(blocks, rows, columns);
}

}  // namespace

Eigen::MatrixXd SteadyResidual::jacobian_rows(const ResidualState& state, const std::vector<Eigen::Index>& rows) const {
  Eigen::MatrixXd result;
  assemble_rows(blocks(state), rows, result);
  return result;
}

void SteadyResidual::jacobian(const ResidualState& state, Eigen::MatrixXd& into) const {
  if (budget_) budget_->spend(factorisation_operations(unknowns()));
  std::vector<Eigen::Index> rows(static_cast<std::size_t>(unknowns()));
  std::iota(rows.begin(), rows.end(), Eigen::Index{0});
  assemble_rows(blocks(state), rows, into);
}

Eigen::MatrixXd SteadyResidual::jacobian(const ResidualState& state) const {
  Eigen::MatrixXd result;
  jacobian(state, result);
  return result;
}

Eigen::MatrixXd SteadyResidual::closed_start() const {
  const Eigen::Index nodes = model_->nodes(), d = model_->directions();
  Eigen::MatrixXd start = Eigen::MatrixXd::Zero(nodes * d, basis_.coefficients());
  std::vector<Eigen::Index> free, held;
  for (Eigen::Index i = 0; i < nodes; ++i)
    for (Eigen::Index r = 0; r < d; ++r) {
      (released(i) ? free : held).push_back(i * d + r);
      if (!released(i)) start(i * d + r, 0) = r == 0 ? offset_(i * d) : condition_.slip_origin(i, r - 1);
    }
  if (free.empty()) return start;
  // Without contact force, released nodes obey Z U = F next to the held ones.
  const Eigen::MatrixXd rest = system_->force - apply_stiffness(*system_, start);
  for (std::size_t h = 0; h < system_->harmonics.size(); ++h) {
    const Eigen::MatrixXcd block = system_->harmonics[h].stiffness(free, free);
    const auto j = static_cast<Eigen::Index>(h);
    numerics::DenseLu lu(real_block(block, j));
    if (lu.status() != Status::converged) continue;
    const Eigen::MatrixXd columns =
        h == 0 ? Eigen::MatrixXd(rest.col(0)) : Eigen::MatrixXd(rest.middleCols(2 * j - 1, 2));
    const Eigen::MatrixXd load = columns(free, Eigen::all);
    const Eigen::MatrixXd solved = lu.solve(Eigen::MatrixXd(load.reshaped(load.size(), 1)));
    for (std::size_t q = 0; q < free.size(); ++q)
      for (Eigen::Index c = 0; c < load.cols(); ++c)
        start(free[q], h == 0 ? 0 : 2 * j - 1 + c) = solved(static_cast<Eigen::Index>(q) + c * load.rows(), 0);
  }
  return start;
}

double SteadyResidual::relative_norm(const Eigen::MatrixXd& residual) const {
  return residual.norm() / system_->force_scale;
}

}  // namespace dovetail::response
