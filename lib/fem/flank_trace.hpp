#pragma once

#include <vector>

#include "fem/sector_mesh.hpp"

namespace dovetail::fem {

/// The sector with contact on everything its mesh can resolve: the trace of a flank has a node at every matched pair
/// across the slot, where the relative displacement is quadratic between corners, and along the slot at the ends of the
/// layers, linear between. Contact nodes are laid on it afterwards (ContactCells).
[[nodiscard]] SectorMesh with_trace(const SectorMesh& sector);

/// Where the trace nodes of a flank lie, as fractions of the flank from 0 to 1: [grid[0]] across, corners and mid-sides
/// in turn, and [grid[1]] along the slot ({0} in the plane).
struct TraceLines {
  std::vector<double> across, along;
};
[[nodiscard]] TraceLines trace_lines(const Flank& trace);

}  // namespace dovetail::fem
