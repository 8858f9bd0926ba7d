#include "wear/steady_rate.hpp"

#include <numeric>

namespace dovetail::wear {

bool insensitive_to_wear(const steady::State& state, double depth, double change) {
  const double fastest = state.wear_rate.size() == 0 ? 0.0 : state.wear_rate.maxCoeff();
  if (!(fastest > 0.0) || !state.tangent) return false;
  std::vector<Eigen::Index> nodes(static_cast<std::size_t>(state.wear_rate.size()));
  std::iota(nodes.begin(), nodes.end(), Eigen::Index{0});
  const Eigen::VectorXd moved = state.tangent->wear_rate_to_wear(nodes) * (depth / fastest * state.wear_rate);
  return moved.cwiseAbs().maxCoeff() <= change * fastest;
}

}  // namespace dovetail::wear
