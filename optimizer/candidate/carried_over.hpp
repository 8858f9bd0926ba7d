#pragma once

#include <Eigen/Core>
#include <vector>

#include "fem/contact_cells.hpp"

namespace dovetail::optimizer {

/// Displacements U [nc, 2H+1] of one grid of contact cells carried over to another of the same joint, linear between
/// the middles of cells, strip by strip where they lie along the slot: a start for the state there.
[[nodiscard]] Eigen::MatrixXd carried_over(const Eigen::MatrixXd& from, const std::vector<fem::CellStrip>& before,
                                           const std::vector<fem::CellStrip>& after, Eigen::Index directions);

}  // namespace dovetail::optimizer
