#pragma once

#include <Eigen/Core>

#include "geometry/profile/params.hpp"
#include "geometry/profile/profile.hpp"

namespace dovetail::geometry {

/// How much the stress counts as the fillet's at a distance from the flank's end along the boundary, in radii of the
/// fillet: 0 up to FilletShareParams::from, 1 from `to` on, in between smooth (cubic) in the design. At the end of a
/// flank that bears with a sharp edge, pressure and stress grow without bound as the mesh is refined, whatever the
/// fillet.
[[nodiscard]] double fillet_share(double distance_in_radii);

/// The same for nodes [2, n] on the arc `fillet`. Its end next to the flank (start or end of the edge) lies `straight`
/// from the flank's end.
[[nodiscard]] Eigen::VectorXd fillet_shares(const Edge& fillet, bool flank_at_start, double straight,
                                            const Eigen::Matrix2Xd& nodes);

}  // namespace dovetail::geometry
