#pragma once

#include <vector>

#include "fem/contact_cells.hpp"
#include "fem/flank_trace.hpp"
#include "optimizer/scene/scene.hpp"

namespace dovetail::optimizer {

/// How long contact cells are across the slot, in edges of the mesh where they lie.
struct CellLengths {
  double finest = 1;     ///< >= 0.5, at the ends of a flank and beside the edges of worn zones
  double coarsest = 4;   ///< >= finest, of the longest ones
  double growth = 0.35;  ///< > 0, of the length with the distance from an end or edge
};

/// Those of a scene: mesh.contact_flank_elements, which asks for fewer cells than the mesh has edges, makes them
/// longer.
[[nodiscard]] CellLengths cell_lengths(const Scene& scene, CellLengths lengths = {});

/// Length of the mesh's edge at a place on a flank, as fractions of the flank: linear between the middles of edges, so
/// that it does not jump where an edge of a worn zone passes a node of the mesh.
class EdgeLengths {
 public:
  explicit EdgeLengths(const fem::TraceLines& lines);
  [[nodiscard]] double at(double place) const;

 private:
  std::vector<double> middles_, lengths_;
};

/// Ends of cells over a flank with an end on each of `edges` (rising, inside 0 to 1). `counts`: of the cells between
/// two of them; those of the last grid stay while they differ by one from what the lengths ask for: where an edge is
/// found depends a little on the number of cells, and must not go to and fro between two of them.
[[nodiscard]] std::vector<double> cell_ends(const EdgeLengths& edge_lengths, const std::vector<double>& edges,
                                            const CellLengths& lengths, std::vector<int>& counts);

/// The grid to begin with, without edges of worn zones: finest at the ends of the flanks, where pressures peak and wear
/// begins. Along the slot as many strips as the mesh has layers, or mesh.contact_slot_elements.
[[nodiscard]] std::vector<fem::FlankCells> cell_grid(const Scene& scene, const fem::SectorMesh& trace,
                                                     const CellLengths& lengths);

}  // namespace dovetail::optimizer
