#pragma once

#include "reduction/reduced_model.hpp"

namespace dovetail::wear::scenes {

/// Zero matrices of `size` coordinates, the first of them those of the contact nodes in turn (normal, tangential ones),
/// unit areas and one output.
[[nodiscard]] reduction::ReducedModel empty_model(Eigen::Index size, Eigen::Index nodes, Eigen::Index harmonics,
                                                  Eigen::Index tangential = 1);

}  // namespace dovetail::wear::scenes
