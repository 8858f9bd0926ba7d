#pragma once

#include <vector>

#include "wear/asymptote/followed_asymptote.hpp"
#include "wear/node_line.hpp"

namespace dovetail::wear {

struct RestOptions {
  AsymptoteOptions asymptote = {};  ///< its arbitration is what comes_to_rest decides
  bool follow = false;              ///< the resonance of the joint as worn, see followed_asymptote
  bool history = true;  ///< asks the history where the direct answer is in doubt, not only where there is none
  /// Neighbours, of contact nodes that end where worn zones do; of other nodes none.
  std::vector<NodeLine> lines = {};
};

/// A history that was asked and came to no end.
enum class Unfinished {
  none,
  history,
  history_budget,  ///< it spent its budget
  finer_history,   ///< the one with more harmonics and samples
};

/// Where wear comes to rest.
struct Rest : FollowedAsymptote {
  Unfinished unfinished = Unfinished::none;
};

/// The rule for where wear comes to rest. The direct answer is looked for first, and by the history where there is
/// none. Where it is in doubt, the history decides, with these exceptions, in which the direct answer stands, in doubt:
/// - the history does not come to an end;
/// - it ends within a node of the direct answer at the ends of worn zones (a_node_apart): on other nodes it may well
///   end in it;
/// - the two volumes are far apart, and a second history with 2H+1 harmonics and 2N samples ends nearer to the direct
///   one. Which nodes lift off first may hang on harmonics and samples: then histories of neighbouring designs and
///   meshes end far from one another, and more of both tell where wear goes. Where that one comes to no end, the
///   first history decides.
///
/// What did not decide is in other_states. Without lines only the first of them holds: on nodes that are laid without
/// regard to worn zones the direct answer wears off whole nodes as well, and nothing speaks for it against the history.
/// - `unworn`: steady state of `joint` at omega, or null
///
/// Cost: a direct answer; in doubt a history besides, and where that ends elsewhere the direct answer once more and a
/// second history at twice the harmonics and samples. Throws as asymptote() does.
[[nodiscard]] Rest comes_to_rest(const steady::Joint& joint, double omega, const RestOptions& options,
                                 const steady::State* unworn = nullptr, const Watcher& watcher = {});

}  // namespace dovetail::wear
