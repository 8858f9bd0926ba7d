#include "wear/history/steady_rate.hpp"

#include <algorithm>
#include <numeric>

#include "wear/measures.hpp"
#include "wear/params.hpp"

namespace dovetail::wear {

bool unchanged_while_doubling(const std::vector<WornRecord>& records) {
  constexpr LevelParams kLevel;
  const WornRecord& last = records.back();
  if (last.depth.size() == 0) return false;
  const double deep = last.depth.maxCoeff();
  const auto earlier = std::find_if(records.rbegin(), records.rend(), [deep](const WornRecord& record) {
    return record.depth.maxCoeff() <= kLevel.earlier * deep;
  });
  if (earlier == records.rend() || earlier->depth.maxCoeff() < kLevel.first * deep) return false;
  const Eigen::VectorXd rise = (last.rate - earlier->rate) / last.rate.maxCoeff();
  return rise.minCoeff() >= -kLevel.change && rise.maxCoeff() <= kLevel.rise;
}

bool insensitive_to_wear(const steady::State& state, double depth) {
  const double fastest = largest(state.wear_rate);
  if (!(fastest > 0.0) || !state.tangent) return false;
  std::vector<Eigen::Index> nodes(static_cast<std::size_t>(state.wear_rate.size()));
  std::iota(nodes.begin(), nodes.end(), Eigen::Index{0});
  const Eigen::VectorXd moved = state.tangent->wear_rate_to_wear(nodes) * (depth / fastest * state.wear_rate);
  return moved.cwiseAbs().maxCoeff() <= LevelParams{}.change * fastest;
}

}  // namespace dovetail::wear
