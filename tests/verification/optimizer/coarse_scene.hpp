#pragma once

#include "optimizer/scene/scene.hpp"

namespace dovetail::optimizer {

/// A section whose evaluation takes half a second, and which wears.
inline Scene coarse_scene() {
  Scene scene;
  scene.mesh.flank_elements = 12;
  scene.mesh.fillet_fraction = 0.2;
  scene.mesh.bulk_size = 4e-3;
  scene.geometry.flank("left").mismatch = scene.geometry.flank("right").mismatch = 4e-6;
  return scene;
}

}  // namespace dovetail::optimizer
