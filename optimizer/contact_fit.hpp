#pragma once

#include <vector>

#include "fem/contact_cells.hpp"
#include "optimizer/candidate_model.hpp"
#include "wear/zone_edges.hpp"

namespace dovetail::optimizer {

struct Computation;

struct ContactFitOptions {
  /// >= 0. Grids of contact nodes tried at most; 0 leaves the model as it was built.
  int grids = 6;
  /// > 0. Edges that would move by less than this have been found, in lengths of the mesh's edge there.
  double tolerance = 0.02;
  /// >= 0.5. Length of the cells at the ends of a flank and beside the edges of worn zones, in edges of the mesh there.
  double finest = 1;
  /// >= finest. Length of the longest cells, in edges of the mesh.
  double coarsest = 4;
  /// > 0. Growth of the cells' length with the distance from an end or edge.
  double growth = 0.35;
};

struct ContactFit {
  int grids = 0;        ///< laid, the first not counted
  double moved = 0;     ///< largest change of an edge that another grid would have made, in lengths of the mesh's edge
  bool settled = true;  ///< `moved` is within the tolerance
  int edges = 0;        ///< of worn zones
};

/// The grid to begin with: finest at the ends of the flanks, where pressures peak and wear begins.
[[nodiscard]] std::vector<fem::FlankCells> contact_grid(const fem::SectorMesh& trace,
                                                        const ContactFitOptions& options = {});

/// Lays contact nodes on a candidate so that the worn zones of its asymptote at the unworn resonance end where nodes
/// end: edges are found on one grid, a grid is laid with an end of a cell on each of them, and so on until they stay.
/// Worn volume and profile are then those of whole nodes, and continuous in the design.
/// Where there are no edges, or the wear cannot be found, the model stays as it is.
ContactFit fit_contact(const Scene& scene, const Computation& how, CandidateModel& candidate);

}  // namespace dovetail::optimizer
