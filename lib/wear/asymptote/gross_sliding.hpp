#pragma once

#include <Eigen/Core>

#include "steady/state.hpp"
#include "wear/params.hpp"

namespace dovetail::wear {

/// What a state at rest leaves of a contact that alone holds its body. Near gross sliding nodes go on being worn off
/// until the last ones that bear hold the whole joint like a hinge on which it rocks: a solution of the linear
/// equations for small sliding, but no state of the joint. Where the structure holds the body without contact (springs,
/// a negative gap) wear may well take all the load away, and nothing is judged.
struct Bearing {
  bool needed = false;   ///< nothing but the contact holds the body
  double share = 1.0;    ///< area over which the load is spread, of that before wear; above 1 where wear evens it out
  double closing = 0.0;  ///< largest depth over the compression of the unworn flank, see flank_compression

  /// So little bears, or the flanks have closed so far on what does, that only the history can confirm the state.
  [[nodiscard]] bool doubtful() const {
    return needed && (share < BearingParams{}.few || closing > BearingParams{}.deep);
  }
  /// No state, whoever finds it.
  [[nodiscard]] bool impossible() const { return needed && closing > BearingParams{}.too_deep; }
};

/// By how much the load compresses a flank, m: the mean over its loaded nodes of lambda_N over the node's own stiffness
/// times the number of nodes across, which makes it p L / E of the flank whatever the mesh. Of the flank with the most.
[[nodiscard]] double flank_compression(const dynamics::CondensedModel& model, const steady::State& state);

/// - `unworn`: the state before wear
/// - `worn`: the state at rest
/// - `depth`: [Nc] what it has worn, m
[[nodiscard]] Bearing bearing(const dynamics::CondensedModel& model, const steady::State& unworn,
                              const steady::State& worn, const Eigen::VectorXd& depth);

}  // namespace dovetail::wear
