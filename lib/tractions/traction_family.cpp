#include "tractions/traction_family.hpp"

#include <cassert>
#include <limits>

#include "numerics/dense_general.hpp"
#include "numerics/dense_product.hpp"
#include "numerics/dense_symmetric.hpp"
#include "tractions/params.hpp"

namespace dovetail::tractions {
namespace {

// Inverse of a symmetric matrix on the directions it has stiffness in: others carry no residual traction.
Eigen::MatrixXd pseudo_inverse(const Eigen::MatrixXd& matrix) {
  if (matrix.rows() == 0) return matrix;
  const numerics::SymmetricPairs pairs = numerics::all_pairs<double>((matrix + matrix.transpose()) / 2);
  const double largest = pairs.values.cwiseAbs().maxCoeff();
  Eigen::VectorXd inverse = pairs.values;
  for (double& value : inverse) value = std::abs(value) > SearchParams{}.nothing * largest ? 1 / value : 0;
  return numerics::product(Eigen::MatrixXd(pairs.vectors * inverse.asDiagonal()), pairs.vectors.transpose());
}

}  // namespace

Eigen::MatrixXd mean_tractions(const steady::State& state, const dynamics::CondensedModel& model) {
  const Eigen::Index nodes = model.nodes(), d = model.directions();
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(nodes, std::max<Eigen::Index>(d - 1, 0));
  for (Eigen::Index i = 0; i < nodes; ++i) {
    const double limit = model.contact_law(i).limit(state.force(i * d, 0)).force;
    if (limit > 0) result.row(i) = state.force.col(0).segment(i * d + 1, d - 1).transpose() / limit;
  }
  return result;
}

TractionFamily::TractionFamily(const steady::State& nominal) {
  assert(nominal.tangent);
  const steady::Problem& problem = nominal.tangent->problem();
  const dynamics::CondensedModel& model = problem.model();
  const Eigen::Index count = model.nodes(), d = model.directions();
  origin_ = problem.condition().slip_origin;
  std::vector<Eigen::Index> stuck, free;
  std::vector<double> limit;
  for (Eigen::Index i = 0; i < count; ++i) {
    const steady::NodeSummary& node = nominal.nodes[static_cast<std::size_t>(i)];
    if (node.stuck && model.contact_law(i).rubs()) {
      nodes_.push_back(i);
      limit.push_back(model.contact_law(i).limit(nominal.force(i * d, 0)).force);
      // Where it ended if it slipped before it stayed stuck.
      origin_.row(i) = nominal.slip_end.row(i);
      for (Eigen::Index r = 1; r < d; ++r) stuck.push_back(i * d + r);
    } else {
      if (!node.carries_load) free.push_back(i * d);
      for (Eigen::Index r = 1; r < d; ++r) free.push_back(i * d + r);
    }
  }
  limit_ = Eigen::Map<const Eigen::VectorXd>(limit.data(), static_cast<Eigen::Index>(limit.size()));
  const Eigen::MatrixXd stiffness = problem.system().stiffness.mean();
  Eigen::MatrixXd seen = stiffness(stuck, stuck);
  if (!free.empty()) {
    const Eigen::MatrixXd across = stiffness(free, stuck);
    constexpr double kRounding = std::numeric_limits<double>::epsilon();
    const double threshold = kRounding * static_cast<double>(free.size());
    seen -= numerics::transposed_product(across, numerics::least_squares(stiffness(free, free), across, threshold));
  }
  compliance_ = pseudo_inverse(seen);
  nominal_ = mean_tractions(nominal, model)(nodes_, Eigen::all);
}

Eigen::MatrixXd TractionFamily::slip_origin(const Eigen::MatrixXd& traction) const {
  // d lambda_T = -K dX_T, node by node in rows.
  const Eigen::MatrixXd change = limit_.asDiagonal() * (traction - nominal_);
  const Eigen::MatrixXd by_node = change.transpose();
  const Eigen::VectorXd moved = -compliance_ * by_node.reshaped();
  const Eigen::MatrixXd shift = moved.reshaped(by_node.rows(), by_node.cols()).transpose();
  Eigen::MatrixXd origin = origin_;
  for (std::size_t i = 0; i < nodes_.size(); ++i) origin.row(nodes_[i]) += shift.row(static_cast<Eigen::Index>(i));
  return origin;
}

Eigen::MatrixXd TractionFamily::gradient(const Eigen::MatrixXd& by_slip_origin) const {
  const Eigen::MatrixXd by_node = by_slip_origin(nodes_, Eigen::all).transpose();
  const Eigen::VectorXd pulled = -compliance_ * by_node.reshaped();
  return limit_.asDiagonal() * pulled.reshaped(by_node.rows(), by_node.cols()).transpose();
}

Eigen::MatrixXd TractionFamily::admissible(Eigen::MatrixXd traction) {
  for (Eigen::Index i = 0; i < traction.rows(); ++i) {
    const double length = traction.row(i).norm();
    if (length > 1) traction.row(i) /= length;
  }
  return traction;
}

}  // namespace dovetail::tractions
