#include "wear/asymptote/depth_scale.hpp"

#include "wear/asymptote/asymptote.hpp"
#include "wear/measures.hpp"

namespace dovetail::wear {

DepthScale depth_scale(const steady::Joint& joint, double omega, double rate_threshold, const steady::State* unworn,
                       const Watcher& watcher) {
  AsymptoteOptions options;
  options.rate_threshold = rate_threshold;
  options.arbitration = Arbitration::never;
  options.certify = options.certify_finer = false;
  const Asymptote found = asymptote(joint, omega, options, unworn, watcher);
  DepthScale scale{.status = found.unworn.status, .solves = found.solves, .jacobians = found.jacobians};
  if (scale.status != Status::converged) return scale;
  scale.released = found.verdict == Verdict::asymptote;
  if (scale.released) {
    const Eigen::VectorXd& start = joint.condition.wear_depth;
    const Eigen::VectorXd worn = start.size() > 0 ? Eigen::VectorXd(found.depth - start) : found.depth;
    scale.depth = largest(worn);
  } else {
    scale.depth = largest_penetration(*joint.model, found.unworn);
  }
  return scale;
}

}  // namespace dovetail::wear
