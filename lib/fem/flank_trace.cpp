#include "fem/flank_trace.hpp"

#include <cassert>
#include <cmath>

namespace dovetail::fem {

namespace {

/// Matched pairs of one line across the slot: those at the height of the first one.
int pairs_across(const Flank& flank, const Mesh& mesh) {
  if (mesh.dimensions() == 2) return static_cast<int>(flank.pairs.size());
  const double height = mesh.nodes(2, flank.pairs.front()[0]);
  int count = 0;
  while (static_cast<std::size_t>(count) < flank.pairs.size() &&
         mesh.nodes(2, flank.pairs[static_cast<std::size_t>(count)][0]) == height)
    ++count;
  return count;
}

Flank traced(const Flank& flank, const Mesh& mesh) {
  Flank trace = flank;
  const int across = pairs_across(flank, mesh);
  const int levels = static_cast<int>(flank.pairs.size()) / across;
  assert(across * levels == static_cast<int>(flank.pairs.size()) && (levels == 1 || levels % 2 == 1));
  // Levels are the ends and middles of layers in turn; the trace has the ends.
  trace.grid = {across, (levels + 1) / 2};
  std::vector<Eigen::Triplet<double>> weights;
  for (int level = 0; level < levels; ++level)
    for (int i = 0; i < across; ++i) {
      const int row = i + across * level;
      if (level % 2 == 0) {
        weights.emplace_back(row, i + across * (level / 2), 1.0);
        continue;
      }
      for (const int end : {level / 2, level / 2 + 1}) weights.emplace_back(row, i + across * end, 0.5);
    }
  trace.interpolation.resize(static_cast<Eigen::Index>(flank.pairs.size()), trace.contact_count());
  trace.interpolation.setFromTriplets(weights.begin(), weights.end());

  const Eigen::VectorXd gap = flank.pair_gap.size() > 0 ? flank.pair_gap
                              : flank.gap.size() > 0    ? Eigen::VectorXd(flank.interpolation * flank.gap)
                                                        : Eigen::VectorXd();
  trace.position.resize(mesh.dimensions(), trace.contact_count());
  trace.gap.resize(gap.size() > 0 ? trace.contact_count() : 0);
  for (int node = 0; node < trace.contact_count(); ++node) {
    const int pair = node % across + across * 2 * (node / across);
    trace.position.col(node) = mesh.nodes.col(flank.pairs[static_cast<std::size_t>(pair)][0]);
    if (gap.size() > 0) trace.gap[node] = gap[pair];
  }
  return trace;
}

}  // namespace

SectorMesh with_trace(const SectorMesh& sector) {
  SectorMesh result = sector;
  for (Flank& flank : result.flanks) flank = traced(flank, sector.mesh);
  return result;
}

TraceLines trace_lines(const Flank& trace) {
  const int across = trace.grid[0], along = trace.grid[1];
  const auto fractions = [&](int count, int step) {
    std::vector<double> result(static_cast<std::size_t>(count), 0.0);
    const Eigen::VectorXd first = trace.position.col(0);
    const double length = (trace.position.col((count - 1) * step) - first).norm();
    for (int i = 1; i < count; ++i)
      result[static_cast<std::size_t>(i)] = (trace.position.col(i * step) - first).norm() / length;
    result.back() = count > 1 ? 1.0 : 0.0;
    return result;
  };
  return {.across = fractions(across, 1), .along = fractions(along, across)};
}

}  // namespace dovetail::fem
