#pragma once

#include <Eigen/Core>

#include "geometry/corner_mesh.hpp"
#include "geometry/profile.hpp"

namespace dovetail::geometry {

/// How far the corner nodes of a blade follow its aerofoil (1) or its root (0): 1 on the aerofoil and its first line,
/// 0 up to the upper end of the straight neck and on the platform's sides, between them the solution of
/// `K w = 0`, K the conduction matrix of linear triangles with conductivity 1/area (small elements are carried along
/// rather than squeezed; compare ElasticMotion). Within 0 ... 1. `reference` is the chain `mesh` was made from.
[[nodiscard]] Eigen::VectorXd morph_weights(const CornerMesh& mesh, const Chain& reference);

}  // namespace dovetail::geometry
