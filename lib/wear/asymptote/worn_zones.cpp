#include "wear/asymptote/worn_zones.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "wear/measures.hpp"
#include "wear/params.hpp"

namespace dovetail::wear {

namespace {

/// Whether the worn nodes of both are the same but for single ones at the ends of zones, of which there is one at
/// least. Nodes on no line must be the same.
bool ends_differ(std::span<const NodeLine> lines, const std::vector<bool>& one, const std::vector<bool>& other) {
  std::vector<bool> compared(one.size(), false);
  bool apart = false;
  for (const NodeLine& line : lines) {
    const auto count = static_cast<std::ptrdiff_t>(line.count());
    const auto node = [&](std::ptrdiff_t k) {
      return static_cast<std::size_t>(line.nodes[static_cast<std::size_t>(k)]);
    };
    const auto in = [&](const std::vector<bool>& nodes, std::ptrdiff_t k) {
      return k >= 0 && k < count && nodes[node(k)];
    };
    const auto differs = [&](std::ptrdiff_t k) { return in(one, k) != in(other, k); };
    const auto worn = [&](std::ptrdiff_t k) { return in(one, k) && in(other, k); };
    for (std::ptrdiff_t k = 0; k < count; ++k) {
      compared[node(k)] = true;
      if (!differs(k)) continue;
      if (differs(k + 1) || worn(k - 1) == worn(k + 1)) return false;
      apart = true;
    }
  }
  for (std::size_t i = 0; i < one.size(); ++i)
    if (!compared[i] && one[i] != other[i]) return false;
  return apart;
}

}  // namespace

WornChange width_changed_by(double share, const WornChange& zone) {
  return {.volume = std::min(1.0, 2.5 * share) * zone.volume, .depth = std::min(1.0, 1.5 * share) * zone.depth};
}

WornChange ends_moved_by(double part, std::span<const NodeLine> lines, const Eigen::VectorXd& area,
                         const std::vector<bool>& worn, const Eigen::VectorXd& depth) {
  WornChange moved;
  for (const NodeLine& line : lines) {
    const std::size_t count = line.count();
    const auto is_worn = [&](std::size_t k) { return worn[static_cast<std::size_t>(line.nodes[k])]; };
    for (std::size_t from = 0, to = 0; from < count; from = to + 1) {
      to = from;
      if (!is_worn(from)) continue;
      while (to + 1 < count && is_worn(to + 1)) ++to;
      double open = 0;
      if (from > 0) open += line.length(from);
      if (to + 1 < count) open += line.length(to);
      const double share = part * open / (line.ends[to + 1] - line.ends[from]);
      double volume = 0, deepest = 0;
      for (std::size_t k = from; k <= to; ++k) {
        const int node = line.nodes[k];
        volume += area[node] * depth[node];
        deepest = std::max(deepest, depth[node]);
      }
      const WornChange of_zone = width_changed_by(share, {.volume = volume, .depth = deepest});
      moved.volume += of_zone.volume;
      moved.depth = std::max(moved.depth, of_zone.depth);
    }
  }
  return moved;
}

bool far_apart(const Eigen::VectorXd& area, const Eigen::VectorXd& one, const Eigen::VectorXd& other) {
  const double first = area.dot(one), second = area.dot(other);
  return std::abs(first - second) > ApartParams{}.most * std::max(first, second);
}

bool a_node_apart(std::span<const NodeLine> lines, const Eigen::VectorXd& area, const Eigen::VectorXd& one,
                  const Eigen::VectorXd& other) {
  const std::vector<bool> worn_one = worn_nodes(one), worn_other = worn_nodes(other);
  if (!ends_differ(lines, worn_one, worn_other)) return false;
  // The wider of the two is what the last node would belong to.
  const bool first_wider = area.dot(one) > area.dot(other);
  const WornChange explained =
      first_wider ? ends_moved_by(1, lines, area, worn_one, one) : ends_moved_by(1, lines, area, worn_other, other);
  return !far_apart(area, one, other) && std::abs(area.dot(one) - area.dot(other)) <= explained.volume &&
         std::abs(one.maxCoeff() - other.maxCoeff()) <= explained.depth;
}

double energy_left_open(std::span<const NodeLine> lines, const Eigen::VectorXd& area, const Eigen::VectorXd& energy,
                        const std::vector<bool>& loaded) {
  constexpr OpenEnergyParams kParams;
  double open = 0;
  for (const NodeLine& line : lines) {
    const auto count = static_cast<std::ptrdiff_t>(line.count());
    const auto node = [&](std::ptrdiff_t k) { return line.nodes[static_cast<std::size_t>(k)]; };
    const auto density = [&](std::ptrdiff_t k) { return energy[node(k)] / area[node(k)]; };
    const auto in = [&](std::ptrdiff_t k) { return k >= 0 && k < count; };
    for (std::ptrdiff_t k = 0; k < count; ++k)
      for (const std::ptrdiff_t way : {-1, 1}) {
        const std::ptrdiff_t next = k + way;
        if (energy[node(k)] <= 0 || !in(next) || !loaded[static_cast<std::size_t>(node(next))] ||
            density(next) >= kParams.sticks * density(k))
          continue;
        double zone = 0;
        for (std::ptrdiff_t i = k; in(i) && density(i) > kParams.sticks * density(k); i -= way) zone += energy[node(i)];
        const double end = density(k) * (area[node(k)] + area[node(next)]) / 2;
        open += kParams.part * end * std::pow(std::min(1.0, end / zone), 2);
      }
  }
  return open;
}

}  // namespace dovetail::wear
