#pragma once

#include "branches/follow.hpp"

namespace dovetail::paths {

/// Follows the branch of steady states through (omega_from, its response) over the frequency, through its turning
/// points, until the frequency leaves the interval between omega_from and omega_to (rad/s, either order). The last
/// point stands exactly at the end the branch left by: omega_to, or omega_from when it came back. See
/// branches::follow.
///
/// eps stays that of the start along the branch: the answer at a finite number of harmonics depends on it, so changing
/// it would make the branch jump. The start may use the cascade of steady_state, the other points do not.
///
/// `guess` is the response near omega_from or empty. `progress` may return false to stop. Throws InputError on bad
/// options; all else is a status. Cost per point: about 3 factorisations of J and as many condensations of the model.
[[nodiscard]] branches::Branch continuation(const steady::Joint& joint, double omega_from, double omega_to,
                                            const branches::FollowOptions& options = {},
                                            const std::function<bool(const branches::BranchPoint&)>& progress = {},
                                            const Eigen::MatrixXd& guess = {});

}  // namespace dovetail::paths
