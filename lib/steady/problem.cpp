#include "steady/problem.hpp"

#include <string>

#include "dynamics/real_block.hpp"
#include "numerics/dense_lu.hpp"
#include "steady/params.hpp"

namespace dovetail::steady {
namespace {

// Fills empty members of a condition and refuses others of a wrong size.
void complete(const dynamics::CondensedModel& model, Condition& condition) {
  const Eigen::Index nodes = model.nodes(), d = model.directions();
  const auto require = [](bool good, const char* key, Eigen::Index found, Eigen::Index wanted) {
    if (!good)
      throw InputError({.file = {},
                        .key = key,
                        .value = "size " + std::to_string(found),
                        .allowed = "must be empty or have size " + std::to_string(wanted)});
  };
  if (condition.wear_depth.size() == 0) condition.wear_depth = Eigen::VectorXd::Zero(nodes);
  if (condition.released.empty()) condition.released.assign(static_cast<std::size_t>(nodes), 0);
  if (condition.slip_origin.size() == 0) condition.slip_origin = model.contact().slip_origin;
  require(condition.wear_depth.size() == nodes, "wear_depth", condition.wear_depth.size(), nodes);
  require(static_cast<Eigen::Index>(condition.released.size()) == nodes, "released",
          static_cast<Eigen::Index>(condition.released.size()), nodes);
  require(condition.slip_origin.rows() == nodes && condition.slip_origin.cols() == d - 1, "slip_origin",
          condition.slip_origin.size(), nodes * (d - 1));
}

}  // namespace

Problem::Problem(const Joint& joint, std::shared_ptr<const dynamics::HarmonicSystem> system, double penalty_ratio)
    : joint_(joint),
      system_(std::move(system)),
      basis_(std::make_shared<const numerics::FourierBasis>(joint.options.harmonics, joint.options.samples)),
      penalty_ratio_(penalty_ratio) {
  complete(model(), joint_.condition);
  set_penalty();
  set_offset();
}

Problem Problem::at(std::shared_ptr<const dynamics::HarmonicSystem> system) const {
  Problem other = *this;
  other.system_ = std::move(system);
  return other;
}

Problem Problem::with_penalty(double ratio) const {
  Problem other = *this;
  other.penalty_ratio_ = ratio;
  other.set_penalty();
  return other;
}

Problem Problem::worn(const Eigen::VectorXd& depth) const {
  Problem other = *this;
  other.joint_.condition.wear_depth = depth;
  other.set_offset();
  return other;
}

void Problem::set_penalty() {
  penalty_ = contact::pseudo_penalty(model().local_stiffness(), model().directions(), options().normal_penalty,
                                     options().tangential_penalty)
                 .scaled(penalty_ratio_ * options().penalty_scale);
  dof_penalty_ = penalty_.by_dof(model().directions());
}

void Problem::set_offset() {
  offset_ = Eigen::VectorXd::Zero(model().contact_size());
  for (Eigen::Index i = 0; i < model().nodes(); ++i)
    offset_(i * model().directions()) = model().contact().gap(i) + condition().wear_depth(i);
}

contact::MarchOptions Problem::march_options() const {
  // Forces of the contact may be far larger than the excitation that the residual is measured by.
  return {.slip_return = options().slip_return,
          .periodic = options().harmonics > 0,
          .max_periods = options().max_periods,
          .tolerance = options().periodic_tolerance,
          .resolution = MarchParams{}.share * options().tolerance * system_->force_scale};
}

contact::NodeLaw Problem::law(Eigen::Index node) const {
  contact::NodeLaw law = model().contact_law(node);
  law.tangential_penalty = penalty_.tangential(node);
  for (Eigen::Index r = 0; r + 1 < model().directions(); ++r) law.slip_origin(r) = condition().slip_origin(node, r);
  return law;
}

Eigen::VectorXd Problem::unit_displacement() const {
  return (system_->force_scale * dof_penalty_.cwiseInverse()).replicate(basis_->coefficients(), 1);
}

Eigen::MatrixXd Problem::closed_start() const {
  const Eigen::Index nodes = model().nodes(), d = model().directions();
  Eigen::MatrixXd start = Eigen::MatrixXd::Zero(nodes * d, basis_->coefficients());
  std::vector<Eigen::Index> free;
  for (Eigen::Index i = 0; i < nodes; ++i)
    for (Eigen::Index r = 0; r < d; ++r) {
      if (released(i))
        free.push_back(i * d + r);
      else
        start(i * d + r, 0) = r == 0 ? offset_(i * d) : condition().slip_origin(i, r - 1);
    }
  if (free.empty()) return start;
  // Without contact force, released nodes obey Z U = F next to the held ones.
  const Eigen::MatrixXd rest = system_->force - dynamics::apply_stiffness(*system_, start);
  for (std::size_t h = 0; h < system_->harmonics.size(); ++h) {
    const Eigen::MatrixXcd block = system_->stiffness.matrix(static_cast<int>(h))(free, free);
    const auto j = static_cast<Eigen::Index>(h);
    numerics::DenseLu lu(dynamics::real_block(block, j));
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

}  // namespace dovetail::steady
