#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "wear/release.hpp"

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

  std::vector<bool> released;   ///< [Nc]
  response::SteadyState state;  ///< with `released`
  int count = 0;                ///< passes done
  Eigen::VectorXd deepest;      ///< [Nc] largest depth that any pass asked for, m
  Status status = Status::converged;
};

/// Releases every loaded node that wears by more than `threshold` m per cycle, solves again, and so on, beginning with
/// `passes.state`. At most `limit` passes.
[[nodiscard]] Ending release_slipping(Release& release, double threshold, int limit, const Control& control,
                                      Passes& passes);

/// The other order: releases only the fastest loaded node of `unworn` and of every state after it, until none wears by
/// more than `threshold`. Depth [Nc] of the state it ends in, or nothing when one could not be solved. One solve per
/// worn node: a look for other states at rest, not a way to the physical one.
[[nodiscard]] std::optional<Eigen::VectorXd> release_worst_first(Release& release, const response::SteadyState& unworn,
                                                                 double threshold);

}  // namespace dovetail::wear
