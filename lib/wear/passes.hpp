#pragma once

#include <Eigen/Core>
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
  Status status = Status::converged;
};

/// Releases every loaded node that wears by more than `threshold` m per cycle, solves again, and so on, beginning with
/// `passes.state`. At most `limit` passes.
[[nodiscard]] Ending release_slipping(Release& release, double threshold, int limit, const Control& control,
                                      Passes& passes);

}  // namespace dovetail::wear
