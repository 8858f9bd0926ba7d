#pragma once

#include <Eigen/Core>

#include "geometry/mesh/corner_mesh.hpp"
#include "geometry/profile/profile.hpp"

namespace dovetail::geometry {

/// How the corner nodes of a blade follow its aerofoil, [corner nodes] each:
struct MorphWeights {
  Eigen::VectorXd chord;      ///< along the chord: 1 on the aerofoil, 0 where the root's sweep holds; 0 ... 1
  Eigen::VectorXd thickness;  ///< across it: distance from the centre line over half the thickness of the aerofoil
                              ///< where its blends end, on its first line; continued below; 0 where the sweep holds.
                              ///< Not to be used on the aerofoil itself
};

/// Both are 0 up to the upper end of the straight neck and on the platform's sides and given on the aerofoil; `chord`
/// also on the platform's top and underside, where it falls linearly from the blends' feet to the sides (the steepest
/// fall decides how far an aerofoil may overhang, see solid_rules.hpp). Elsewhere they solve `K w = 0`, K the
/// conduction matrix of linear triangles with conductivity 1/area: small elements are carried along rather than
/// squeezed; compare ElasticMotion. `reference` is the chain `mesh` was made from.
[[nodiscard]] MorphWeights morph_weights(const CornerMesh& mesh, const Chain& reference);

}  // namespace dovetail::geometry
