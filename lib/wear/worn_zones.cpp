#include "wear/worn_zones.hpp"

#include <algorithm>
#include <cmath>

namespace dovetail::wear {

using Eigen::Index;

namespace {

const NodeInPass& at(const std::vector<NodeInPass>& nodes, Index i) {
  return nodes[static_cast<std::size_t>(i)];
}

// How far a zone reaches beyond its last slipping node, whose overload and load are given, in the direction `step`.
double reach(const std::vector<NodeInPass>& nodes, double excess, double load, Index last, Index step) {
  const auto count = static_cast<Index>(nodes.size());
  Index beyond = last + step;
  // Nodes without load next to a worn zone wear as soon as it lets them touch: they belong to it.
  while (beyond >= 0 && beyond < count && !at(nodes, beyond).loaded) beyond += step;
  const auto open = static_cast<double>(std::abs(beyond - last) - 1);
  if (open > 0 || beyond < 0 || beyond >= count) return open + (beyond < 0 || beyond >= count ? 0.5 : 0.0);
  // A neighbour about to lose its load holds nothing: its margin fades with it.
  const double margin = at(nodes, beyond).margin * (load > 0 ? std::min(1.0, at(nodes, beyond).load / load) : 1.0);
  if (excess <= 0 || !std::isfinite(margin)) return 0;
  return excess / (excess + margin);
}

}  // namespace

void WornZones::extend(const std::vector<NodeInPass>& nodes) {
  const Eigen::VectorXd covered = share();
  std::vector<char> taken(nodes.size(), 0);
  const auto slips = [&](Index i) {
    return i >= 0 && i < count_ && !taken[static_cast<std::size_t>(i)] && at(nodes, i).slips;
  };
  for (const Zone& zone : zones_)
    for (Index i = std::max<Index>(0, static_cast<Index>(std::ceil(zone.from)));
         i < count_ && static_cast<double>(i) <= zone.to; ++i)
      taken[static_cast<std::size_t>(i)] = 1;
  // How far the run of slipping nodes that begins at `first` and goes on in steps of `step` carries an end.
  const auto advance = [&](Index first, Index step) {
    Index last = first;
    while (slips(last + step)) last += step;
    double excess = at(nodes, last).excess;
    // A node half worn already is inside the zone.
    if (last == first) excess *= std::max(0.0, 1 - 2 * covered[first]);
    const double length =
        static_cast<double>(std::abs(last - first)) + reach(nodes, excess, at(nodes, last).load, last, step);
    for (Index i = first; i != last + step; i += step) taken[static_cast<std::size_t>(i)] = 1;
    return length;
  };
  for (Zone& zone : zones_) {
    const Index right = static_cast<Index>(std::floor(zone.to)) + 1,
                left = static_cast<Index>(std::ceil(zone.from)) - 1;
    if (slips(right)) zone.to += advance(right, 1);
    if (slips(left)) zone.from -= advance(left, -1);
  }
  for (Index i = 0; i < count_; ++i) {
    if (!slips(i)) continue;
    Index last = i;
    while (slips(last + 1)) ++last;
    zones_.push_back(
        {.from = static_cast<double>(i) - reach(nodes, at(nodes, i).excess, at(nodes, i).load, i, -1),
         .to = static_cast<double>(last) + reach(nodes, at(nodes, last).excess, at(nodes, last).load, last, 1)});
    i = last;
  }
  merge();
}

void WornZones::merge() {
  std::ranges::sort(zones_, {}, &Zone::from);
  std::vector<Zone> apart;
  for (const Zone& zone : zones_) {
    if (!apart.empty() && zone.from <= apart.back().to)
      apart.back().to = std::max(apart.back().to, zone.to);
    else
      apart.push_back(zone);
  }
  zones_ = std::move(apart);
}

Eigen::VectorXd WornZones::share() const {
  Eigen::VectorXd share = Eigen::VectorXd::Zero(count_);
  for (Index i = 0; i < count_; ++i) {
    const auto place = static_cast<double>(i);
    const double from = i > 0 ? place - 0.5 : place, to = i + 1 < count_ ? place + 0.5 : place;
    for (const Zone& zone : zones_) {
      if (from == to)
        share[i] += zone.from <= place && place <= zone.to ? 1.0 : 0.0;
      else
        share[i] += std::max(0.0, std::min(to, zone.to) - std::max(from, zone.from)) / (to - from);
    }
  }
  return share.cwiseMin(1.0);
}

}  // namespace dovetail::wear
