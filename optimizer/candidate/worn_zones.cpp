#include "optimizer/candidate/worn_zones.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "optimizer/candidate/params.hpp"
#include "wear/measures.hpp"

namespace dovetail::optimizer {

namespace {

/// Where a node is more of the worn volume the nodes are too long to tell. Of designs whose histories end a node apart
/// the direct volume stands on ever shorter nodes where the two differ by up to a fifth; farther apart it is the one
/// or the other.
constexpr double kMost = 0.2;

/// Whether the worn nodes of both are the same but for single ones at the ends of zones, of which there is one at
/// least.
bool ends_differ(const fem::ContactCells& cells, const std::vector<bool>& one, const std::vector<bool>& other) {
  bool apart = false;
  for (const fem::CellStrip& strip : cells.strips()) {
    const auto first = static_cast<std::ptrdiff_t>(strip.first), count = static_cast<std::ptrdiff_t>(strip.count());
    const auto in = [&](const std::vector<bool>& nodes, std::ptrdiff_t k) {
      return k >= 0 && k < count && nodes[static_cast<std::size_t>(first + k)];
    };
    const auto differs = [&](std::ptrdiff_t k) { return in(one, k) != in(other, k); };
    const auto worn = [&](std::ptrdiff_t k) { return in(one, k) && in(other, k); };
    for (std::ptrdiff_t k = 0; k < count; ++k) {
      if (!differs(k)) continue;
      if (differs(k + 1) || worn(k - 1) == worn(k + 1)) return false;
      apart = true;
    }
  }
  return apart;
}

}  // namespace

WornChange width_changed_by(double share, const WornChange& zone) {
  return {.volume = std::min(1.0, 2.5 * share) * zone.volume, .depth = std::min(1.0, 1.5 * share) * zone.depth};
}

WornChange ends_moved_by(double part, const fem::ContactCells& cells, const std::vector<bool>& worn,
                         const Eigen::VectorXd& depth) {
  WornChange moved;
  for (const fem::CellStrip& strip : cells.strips()) {
    const std::size_t first = strip.first, count = strip.count();
    for (std::size_t from = 0, to = 0; from < count; from = to + 1) {
      to = from;
      if (!worn[first + from]) continue;
      while (to + 1 < count && worn[first + to + 1]) ++to;
      double open = 0;
      if (from > 0) open += strip.length(from);
      if (to + 1 < count) open += strip.length(to);
      const double share = part * open / (strip.ends[to + 1] - strip.ends[from]);
      double volume = 0, deepest = 0;
      for (std::size_t k = first + from; k <= first + to; ++k) {
        const auto node = static_cast<Eigen::Index>(k);
        volume += cells.area[node] * depth[node];
        deepest = std::max(deepest, depth[node]);
      }
      const WornChange of_zone = width_changed_by(share, {.volume = volume, .depth = deepest});
      moved.volume += of_zone.volume;
      moved.depth = std::max(moved.depth, of_zone.depth);
    }
  }
  return moved;
}

bool far_apart(const fem::ContactCells& cells, const Eigen::VectorXd& one, const Eigen::VectorXd& other) {
  const double first = cells.area.dot(one), second = cells.area.dot(other);
  return std::abs(first - second) > kMost * std::max(first, second);
}

bool a_node_apart(const fem::ContactCells& cells, const Eigen::VectorXd& one, const Eigen::VectorXd& other) {
  const std::vector<bool> worn_one = wear::worn_nodes(one), worn_other = wear::worn_nodes(other);
  if (!ends_differ(cells, worn_one, worn_other)) return false;
  // The wider of the two is what the last node would belong to.
  const bool first_wider = cells.area.dot(one) > cells.area.dot(other);
  const WornChange explained =
      first_wider ? ends_moved_by(1, cells, worn_one, one) : ends_moved_by(1, cells, worn_other, other);
  return !far_apart(cells, one, other) && std::abs(cells.area.dot(one) - cells.area.dot(other)) <= explained.volume &&
         std::abs(one.maxCoeff() - other.maxCoeff()) <= explained.depth;
}

double energy_left_open(const fem::ContactCells& cells, const Eigen::VectorXd& energy,
                        const std::vector<bool>& loaded) {
  // Slip is largest near the end of a zone that lifts off, and the zone may end anywhere between its last node and the
  // middle of the next, which sticks. The energy between is open by a part that grows with the node's share s of the
  // zone's energy like s^2, as a finer mesh sees what happens in a zone of several nodes. A zone that ends on both
  // sides is open on both.
  constexpr ZoneEndParams kParams;
  const auto density = [&](std::ptrdiff_t k) { return energy[k] / cells.area[k]; };
  double open = 0;
  for (const fem::CellStrip& strip : cells.strips()) {
    const auto first = static_cast<std::ptrdiff_t>(strip.first);
    const std::ptrdiff_t last = first + static_cast<std::ptrdiff_t>(strip.count()) - 1;
    const auto in = [&](std::ptrdiff_t k) { return k >= first && k <= last; };
    for (std::ptrdiff_t k = first; k <= last; ++k)
      for (const std::ptrdiff_t way : {-1, 1}) {
        const std::ptrdiff_t next = k + way;
        if (energy[k] <= 0 || !in(next) || !loaded[static_cast<std::size_t>(next)] ||
            density(next) >= kParams.sticks * density(k))
          continue;
        double zone = 0;
        for (std::ptrdiff_t i = k; in(i) && density(i) > kParams.sticks * density(k); i -= way) zone += energy[i];
        const double end = density(k) * (cells.area[k] + cells.area[next]) / 2;
        open += kParams.part * end * std::pow(std::min(1.0, end / zone), 2);
      }
  }
  return open;
}

}  // namespace dovetail::optimizer
