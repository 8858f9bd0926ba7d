#pragma once

namespace dovetail::fem {

/// Finite elements a mesh may be made of; one kind per mesh.
enum class ElementKind {
  triangle6,  ///< plane: six-node triangle, corners 0,1,2 counter-clockwise, then the mid-sides of 01, 12, 20
  /// space: six-node triangle times three-node line. Layer by layer, each in the order of triangle6: nodes 0-5 at
  /// zeta = -1 (lower z), 6-11 at zeta = 0, 12-17 at zeta = +1.
  wedge18,
};

[[nodiscard]] constexpr int dimensions(ElementKind kind) {
  return kind == ElementKind::triangle6 ? 2 : 3;
}
[[nodiscard]] constexpr int nodes_per_element(ElementKind kind) {
  return kind == ElementKind::triangle6 ? 6 : 18;
}

}  // namespace dovetail::fem
