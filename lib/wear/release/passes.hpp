#pragma once

#include <Eigen/Core>
#include <vector>

#include "wear/release/zone_edges.hpp"
#include "wear/wearing_joint.hpp"

namespace dovetail::wear {

/// How the passes of release ended.
enum class Ending {
  settled,        ///< no loaded node slips
  nothing_holds,  ///< every loaded node slips, and nothing else takes the load over
  failed,         ///< a steady state did not converge, or the passes were used up: see `status`
};

/// What the passes of release know about the nodes.
struct Passes {
  explicit Passes(Eigen::Index nodes);

  std::vector<bool> released;  ///< [Nc]
  steady::State state;         ///< with `released`
  int count = 0;               ///< passes done
  Eigen::VectorXd deepest;     ///< [Nc] largest depth that any pass asked for, m
  std::vector<bool> touching;  ///< [Nc] carried load at times only when it was released
  ReleaseTrail trail;
  Status status = Status::converged;
};

/// Whether a pass releases each node [Nc]: those not `done` that wear by more than `threshold` m per cycle under load.
/// A node that touches at times only waits, however, while another is more than 50 times as fast: it slips a little
/// where it touches down and lifts off as long as the joint moves as it does, and when the fast nodes have come to rest
/// it has hardly worn and may touch without slip.
[[nodiscard]] std::vector<bool> wear_off(const steady::State& state, const std::vector<bool>& done, double threshold);

/// Releases every loaded node that wears by more than `threshold` m per cycle (`wear_off`), solves again, and so on,
/// beginning with `passes.state`. At most `limit` passes.
[[nodiscard]] Ending release_slipping(WearingJoint& joint, double threshold, int limit, const Watcher& watcher,
                                      Passes& passes);

/// The other order of release, towards the one of a history: only nodes at least half as fast as the fastest at each
/// pass, until none wears by more than `threshold`.
struct SlowRelease {
  bool settled = false;
  Eigen::VectorXd depth;    ///< [Nc] of the state it ends in, when settled
  Eigen::VectorXd deepest;  ///< [Nc] largest depth that any pass asked for
};
[[nodiscard]] SlowRelease release_slowly(WearingJoint& joint, const steady::State& unworn, double threshold, int limit);

}  // namespace dovetail::wear
