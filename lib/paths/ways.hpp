#pragma once

#include <Eigen/Core>
#include <memory>

#include "paths/params.hpp"
#include "steady/solve.hpp"
#include "steady/state.hpp"

namespace dovetail::paths {

/// What the ways have come to.
struct Found {
  steady::Attempt attempt;  ///< the last or the best one; its counts are those of all
  steady::Way way = steady::Way::none;
};

/// Tries the ways that the joint's options allow until one leads to a solution. `guess` and `reuse` may be empty.
/// Neighbouring problems spend at most `max_rescue_iterations` Jacobians, more by one attempt for each way.
[[nodiscard]] Found try_ways(const steady::Joint& joint, const std::shared_ptr<const steady::Problem>& problem,
                             const Eigen::MatrixXd& guess, const std::shared_ptr<const steady::Tangent>& reuse,
                             const WayParams& params);

}  // namespace dovetail::paths
