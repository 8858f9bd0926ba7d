#pragma once

#include <span>
#include <vector>

#include "optimizer/candidate/cell_grid.hpp"
#include "wear/asymptote/asymptote.hpp"
#include "wear/release/zone_edges.hpp"

namespace dovetail::optimizer {

/// An edge of a worn zone on a flank.
struct Edge {
  double place = 0;    ///< fraction of the flank
  double end = 0;      ///< where the last cell of the zone ends
  int outwards = 1;    ///< 1: the zone is on the neck side of it, -1: on the root side
  bool grown = false;  ///< by a later pass of release than the one that began the zone
};

/// Edges of every strip, rising. Of the trails of several loads that wear off the same nodes, each edge is where the
/// load has it that goes farthest there.
[[nodiscard]] std::vector<std::vector<Edge>> edge_places(const fem::ContactCells& cells,
                                                         std::span<const wear::ReleaseTrail> trails);

/// The same under a wear law that lets nodes rest in slip, where release does not find the worn zones: a zone ends
/// where the energy of the node beyond it, at rest, would come up to what the law lets it dissipate, if it rose towards
/// the zone as it does before wear.
[[nodiscard]] std::vector<std::vector<Edge>> resting_edges(const fem::ContactCells& cells,
                                                           const dynamics::CondensedModel& model,
                                                           const wear::Asymptote& worn);

/// Zones narrower than the trace resolves: those at the ends of the flank stay as wide as it resolves, others are none.
void widen_narrow(const EdgeLengths& edge_lengths, const CellLengths& lengths, std::vector<double>& edges);

/// How far the worn zones of a grid are from those that it was laid for.
struct Misfit {
  int foreign = 0;  ///< strips on which a zone ends where none was laid to end: a node beyond it wore, too
  int edges = 0;    ///< of zones
  /// Largest way of an edge to where the next grid has it - on strips with more or fewer zones than the grid was laid
  /// for, from the end of its cell - in lengths of the mesh's edge.
  double moved = 0;
  double share = 0;  ///< the same, of the narrower of the two pieces of the flank that meet at the edge

  /// Of a strip: its edges, where they are `held`, where the next grid has them, and where this one was laid for.
  void add(const std::vector<Edge>& edges_now, const std::vector<double>& held, const std::vector<double>& next,
           const std::vector<double>& laid, const EdgeLengths& lengths);
  [[nodiscard]] bool less_than(const Misfit& other) const {
    return foreign != other.foreign ? foreign < other.foreign : moved < other.moved;
  }
};

/// Where the ends of cells are put so that edges found on the grid (`found`) coincide with them: at the zero of found -
/// laid, by the secant through the last two grids, edge by edge. Beside a narrow zone edges move against the cells, and
/// putting the next grid where the last one found them would go to and fro.
class EdgeSearch {
 public:
  using Places = std::vector<std::vector<double>>;  ///< on every strip, fractions of the flank

  /// The places of `edges`. Those that grew in a later pass go on a little further than they have to, and each time
  /// they grow again twice as far, so that the nodes beyond them stick, and do not come back: an earlier pass alone
  /// would end there before.
  Places hold(const std::vector<std::vector<Edge>>& edges, const std::vector<EdgeLengths>& lengths);
  /// Whether an edge is held where the nodes beyond it hardly stick.
  [[nodiscard]] bool holds() const;
  Places next(const Places& found, const Places& laid);

 private:
  struct Held {
    int grown = 0;  ///< how often
    double place = 0;
  };
  Places laid_, found_;
  std::vector<std::vector<Held>> held_;
};

}  // namespace dovetail::optimizer
