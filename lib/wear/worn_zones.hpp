#pragma once

#include <Eigen/Core>
#include <vector>

namespace dovetail::wear {

/// What a node of a flank does in a pass of release.
struct NodeInPass {
  bool loaded = false;
  bool slips = false;  ///< under load
  double excess = 0;   ///< overload that its slip relieves, >= 0: see slip_excess
  double margin = 0;   ///< friction margin of a loaded node that does not slip, >= 0
  double load = 0;     ///< largest normal force, N
};

/// The worn zones of one line of nodes as intervals whose ends lie between nodes, in node spacings.
///
/// Between the last slipping node of a run, overload e, and the next node, which sticks with margin m, the zone ends at
/// the fraction e / (e + m) of the spacing: at the slipping node when that is about to stick, at the sticking one when
/// that is about to slip. Both e and m are close to linear in the place of the edge inside a spacing. Nodes without
/// load next to a zone belong to it: they wear as soon as it lets them touch.
class WornZones {
 public:
  explicit WornZones(std::size_t nodes) : count_(static_cast<Eigen::Index>(nodes)) {}

  /// Slip in nodes outside the zones makes new zones; slip next to an end moves that end on, from where it is, by the
  /// nodes that slip and the fraction beyond. Slip inside does nothing. [nodes]
  void extend(const std::vector<NodeInPass>& nodes);

  /// Part of each node's stretch of flank, half the way to either neighbour, that the zones cover. [nodes]
  [[nodiscard]] Eigen::VectorXd share() const;

 private:
  struct Zone {
    double from = 0, to = 0;
  };
  void merge();

  Eigen::Index count_;
  std::vector<Zone> zones_;  // ascending, apart
};

}  // namespace dovetail::wear
