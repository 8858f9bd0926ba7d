#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "wear/asymptote/asymptote.hpp"
#include "wear/asymptote/gross_sliding.hpp"
#include "wear/node_line.hpp"
#include "wear/release/zone_edges.hpp"

namespace dovetail::wear {

/// One of the loads that act in turn on the same flanks: the joint under it, and its excitation, rad/s. Joints of one
/// mission have the same contact nodes; models, gaps of the preload and friction may differ.
struct MissionLoad {
  steady::Joint joint;
  double omega = 0;
  double share = 1;                       ///< > 0, of the life; only of interest for a history
  const steady::State* unworn = nullptr;  ///< its steady state before wear, or null
};

struct MissionOptions {
  /// `certify` and `certify_finer` are those of each load; the history has a word where loads are let act in turn.
  AsymptoteOptions asymptote;
  std::vector<NodeLine> lines = {};  ///< neighbours, of nodes that end where worn zones do, see RestOptions; or none
  bool turns = true;                 ///< lets the loads act in turn, too; false: only where there is no direct answer
  int rounds = 20;                   ///< >= 1, of all loads, until none of them wears the flanks any further
  double unchanged = 1e-3;           ///< > 0, of the largest depth: a round that changes less is the last
  /// > 0. Two worn states are the same when their depths differ by less, relative, or, with lines, by a node at the
  /// ends of zones.
  double state_tolerance = 1e-2;
};

/// The flanks when no load wears them any further.
struct Mission {
  Verdict verdict = Verdict::not_converged;
  Status status = Status::converged;
  std::optional<std::size_t> failed;  ///< the load at which it ended
  Eigen::VectorXd depth;              ///< [Nc] m
  double worn_volume = 0;             ///< m^3
  double largest_depth = 0;           ///< m
  std::vector<bool> released;         ///< [Nc] worn off in one of them at least
  std::vector<ReleaseTrail> trails;   ///< of every load that wears: the passes are those of all, the reserves its own
  Bearing bearing;                    ///< of the load that wears and has the least to bear on
  bool took_turns = false;            ///< the loads were let act in turn, and came to an end
  /// Another order of the loads, or a history of one of them, ends elsewhere: least and largest volume of those tried.
  bool order_matters = false;
  double least_volume = 0, largest_volume = 0;
  std::vector<steady::State> states;  ///< of every load on the worn flanks
  int solves = 0;
};

/// Limiting worn geometry of all loads together, without a history: with the released nodes free of contact in every
/// load, each node that slips under load in one of them is released, until none does in any; a released node has then
/// worn until it just does not touch in the load that asks for most. Every load is solved once more on these depths.
/// Then the loads are let act in turn, each until it has come to rest, where that is in doubt by its wear history, in
/// the order given and in the reverse one: where these end elsewhere the order of the loads matters. Where the wear law
/// lets nodes rest in slip, of which release knows nothing, the flanks are those that the loads leave in turn. A state
/// that hardly anything bears is an answer only when the loads in turn come to it. Loads of wear coefficient zero ask
/// for no depth. Cost: about three times the asymptotes of all loads; without turns as much as those. Throws InputError
/// for options out of range.
[[nodiscard]] Mission mission(std::span<const MissionLoad> loads, const MissionOptions& options = {},
                              const Watcher& watcher = {});

/// The same by a history in which all loads act at once, each for its share: what alternating ones come to when they
/// change often. Explicit steps that wear the fastest node by `increment`, m, until the largest rate is below
/// `rate_fraction` of the first.
struct MissionHistory {
  Status status = Status::converged;
  bool at_rest = false;
  Eigen::VectorXd depth;
  double worn_volume = 0;
  int steps = 0;
};
struct MissionHistoryOptions {
  double increment = 0;         ///< > 0, m
  double rate_fraction = 1e-3;  ///< > 0
  int steps = 2000;             ///< >= 1
};
[[nodiscard]] MissionHistory mission_history(std::span<const MissionLoad> loads, const MissionHistoryOptions& options,
                                             const Watcher& watcher = {});

}  // namespace dovetail::wear
