#pragma once

#include <Eigen/Core>
#include <memory>

#include "paths/params.hpp"
#include "steady/solve.hpp"

namespace dovetail::paths {

/// Tries the ways that the joint's options allow until one leads to a solution: the last attempt, or the best of those
/// that failed, with the way and the work of all. `guess` and `reuse` may be empty. Neighbouring problems spend at most
/// `max_rescue_iterations` Jacobians, more by one attempt for each way.
[[nodiscard]] steady::Attempt try_ways(const steady::Joint& joint,
                                       const std::shared_ptr<const steady::Problem>& problem,
                                       const Eigen::MatrixXd& guess,
                                       const std::shared_ptr<const steady::Tangent>& reuse, const WayParams& params);

}  // namespace dovetail::paths
