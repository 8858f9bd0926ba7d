#pragma once

#include <span>
#include <vector>

#include "optimizer/candidate/candidate_model.hpp"
#include "optimizer/candidate/cell_grid.hpp"
#include "optimizer/candidate/edge_search.hpp"
#include "optimizer/candidate/stage.hpp"

namespace dovetail::optimizer {

struct CandidateResult;

/// How closely the resonance is found at which edges of worn zones are looked for: that on the last grid is found as
/// closely as the study asks.
struct GridResonanceOptions {
  int harmonics = 1, samples = 32;  ///< of the search from the glued joint, before the one with all
  /// Tolerance of the frequency, over that of the study, in half widths of a resonance without friction. With 1e-2 the
  /// worn volume jumps twice as far between neighbouring designs.
  double of_half_width = 1e-3;
};

struct ContactFitOptions {
  /// False: contact nodes stay where the first grid has them, for responses that know of no vibration.
  bool to_worn_zones = true;
  int grids = 6;            ///< >= 0. Further grids of contact nodes tried at most
  double aim = 0.005;       ///< > 0. No further grid where edges move by less, in lengths of the mesh's edge there
  double tolerance = 0.02;  ///< >= aim. Those that move by less on the last grid have settled
  /// (0, 1). Of what the first resonance has left of the evaluation's budget, that may be spent on finding the edges;
  /// and where that takes a history, or a resonance that is followed, on each grid. Joints far from sliding need a
  /// fiftieth; those about to slide may spend everything on grids, with nothing left for the design itself.
  double share_of_budget = 0.3, share_for_histories = 0.5;
  GridResonanceOptions resonance = {};
  CellLengths lengths;
};

/// What a grid of contact nodes was laid for.
struct LaidGrid {
  EdgeSearch::Places edges;              ///< of worn zones
  std::vector<std::vector<int>> counts;  ///< of cells between edges
  EdgeSearch search;                     ///< that led to them
  double moved = 0;                      ///< by how much they were left, see ContactFit
};

/// An unworn steady state near its resonance, for the search of the resonance to start from.
struct NearResonance {
  double omega = 0;                   ///< rad/s
  Eigen::MatrixXd displacement = {};  ///< m; none where there is none
};

/// Where a search of a grid begins: a state of the joint and the grid it was laid on, and a grid to lay first.
struct FitStart {
  NearResonance unworn = {};
  std::vector<fem::CellStrip> strips = {};
  const LaidGrid* grid = nullptr;
};

struct ContactFit {
  int grids = 0;     ///< laid, the first not counted
  double moved = 1;  ///< largest change of an edge that another grid would have made, in lengths of the mesh's edge; 1
                     ///< where that could not be computed
  double share = 1;  ///< the same, of the narrower of the two pieces of the flank that meet at the edge
  bool settled = false;  ///< `moved` is within the tolerance
  bool known = false;    ///< `moved` could be computed
  bool spent = false;    ///< its share of the budget is spent: the grid of those laid that edges would have left least
  int edges = 0;         ///< of worn zones
  std::vector<NearResonance> unworn = {};  ///< of every load on the nodes laid
  double wear_rate = 0;                    ///< of the first load on them, before wear, m^3 per cycle
  LaidGrid grid = {};
};

/// How a design is computed on a model of it.
struct Computation {
  ContactFitOptions contact = {};
  double penalty_scale = 1;             ///< of the pseudo-penalty
  bool history = false;                 ///< where the direct worn state is in doubt the wear history decides
  Stage until = Stage::worn_resonance;  ///< the last one that is gone through
  /// The same design with other settings: its states are begun with, and its grid where `grid_from` says so.
  const CandidateResult* from = nullptr;
  bool grid_from = false;
};

/// Through this stage and no further. Contact nodes follow worn zones where anything moves: what does not wear yet is
/// then the same as with all stages.
[[nodiscard]] inline Computation until(Stage stage, bool history) {
  Computation how{.history = history, .until = stage};
  how.contact.to_worn_zones = stage >= Stage::unworn;
  return how;
}

/// Lays contact nodes on a candidate so that the worn zones of its asymptote - at the unworn resonance, or where that
/// is followed as the joint wears at its end (not under an energy threshold) - end where nodes end: edges are found on
/// one grid, a grid is laid with an end of a cell on each of them, and so on until they stay. Worn volume and profile
/// are then those of whole nodes, and continuous in the design but for the number of cells. Where there are no edges
/// the first grid stays. Where a state on the way is not found the best grid before it stays.
ContactFit fit_contact(const Scene& scene, const Computation& how, CandidateModel& candidate);

/// A load on the flanks of a design: the design under it, and its model.
struct FlankLoad {
  const Scene* scene;
  CandidateModel* model;
  FitStart start = {};
};

/// The same for loads that act in turn on one pair of flanks, whose contact nodes are then the same in all models: the
/// worn zones are those of the mission (wear::mission, each load at its unworn resonance), which may end elsewhere
/// than those of any load alone. Under an energy threshold, where each of them takes a history, nodes end where the
/// zones of the load end that wears its flanks fastest before anything has worn.
ContactFit fit_contact(std::span<const FlankLoad> loads, const Computation& how);

}  // namespace dovetail::optimizer
