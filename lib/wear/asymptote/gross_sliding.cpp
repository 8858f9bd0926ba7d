#include "wear/asymptote/gross_sliding.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "numerics/dense_symmetric.hpp"
#include "wear/measures.hpp"

namespace dovetail::wear {

namespace {

/// The area over which the load is spread, (sum lambda_N)^2 / sum (lambda_N^2 / A): all of it where pressures are
/// alike, hardly more than one node's where one carries it. Worn nodes that just touch do not count.
double bearing_area(const dynamics::CondensedModel& model, const steady::State& state) {
  double load = 0.0, squares = 0.0;
  for (Eigen::Index i = 0; i < model.nodes(); ++i) {
    const double force = state.nodes[static_cast<std::size_t>(i)].max_normal_force;
    load += force;
    squares += force * force / model.contact().area[i];
  }
  return squares > 0.0 ? load * load / squares : 0.0;
}

bool held_without_contact(const dynamics::CondensedModel& model, double omega) {
  Eigen::MatrixXd stiffness = model.stiffness(0, omega, model.harmonic(0, omega)).real();
  stiffness.diagonal().array() -= BearingParams{}.nothing * stiffness.diagonal().cwiseAbs().maxCoeff();
  return numerics::DenseCholesky(std::move(stiffness)).status() == Status::converged;
}

}  // namespace

double flank_compression(const dynamics::CondensedModel& model, const steady::State& state) {
  const reduction::ContactNodes& contact = model.contact();
  struct Flank {
    double compression = 0.0;
    int nodes = 0;
  };
  std::map<int, Flank> flanks;
  for (Eigen::Index i = 0; i < model.nodes(); ++i) {
    const steady::NodeSummary& node = state.nodes[static_cast<std::size_t>(i)];
    if (!node.carries_load) continue;
    Flank& flank = flanks[contact.group.size() > 0 ? contact.group[i] : 0];
    flank.compression += node.max_normal_force / own_stiffness(model, i, 0);
    ++flank.nodes;
  }
  double largest = 0.0;
  const double tangential = static_cast<double>(model.directions() - 1);
  for (const auto& [group, flank] : flanks)
    largest = std::max(largest, flank.compression / flank.nodes * std::pow(flank.nodes, 1.0 / tangential));
  return largest;
}

Bearing bearing(const dynamics::CondensedModel& model, const steady::State& unworn, const steady::State& worn,
                const Eigen::VectorXd& depth) {
  Bearing left;
  if (depth.size() == 0) return left;
  left.needed = !held_without_contact(model, unworn.omega);
  if (const double before = bearing_area(model, unworn); before > 0.0) left.share = bearing_area(model, worn) / before;
  if (const double compression = flank_compression(model, unworn); compression > 0.0)
    left.closing = depth.maxCoeff() / compression;
  return left;
}

}  // namespace dovetail::wear
