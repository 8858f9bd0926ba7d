#pragma once

#include <Eigen/Core>
#include <span>

#include "fem/material.hpp"
#include "fem/sector_mesh.hpp"

namespace dovetail::fem {

/// What the blade's neck carries for Omega^2 = 1; multiply by Omega^2.
struct NeckTension {
  Eigen::VectorXd force;   ///< [d] centrifugal pull of the blade above the section, N/(rad/s)^2 (no z component)
  double tension = 0;      ///< component normal to the section, N/(rad/s)^2
  double width = 0;        ///< across the slot, m
  double thickness = 0;    ///< along the slot, m
  double mean_stress = 0;  ///< tension / (width thickness), Pa/(rad/s)^2
  double mass = 0;         ///< of the blade above the section, kg
};

/// By equilibrium: nothing but the neck holds what is above it, so the section carries the integral of rho (x, y, 0)
/// over the blade (body 0) beyond the line - in space the plane, along the slot - through the two upper neck nodes.
/// Whole elements are integrated by their quadrature; those the section crosses are taken as simplices with straight
/// edges through their nodes (in the plane the hexagon, in space 24 tetrahedra), each clipped exactly, so the result is
/// continuous in the node positions. In space the slot's direction is the second tangent of the first flank (z without
/// flanks) and the thickness is the section's area over its width, the ends of the neck being planes across z. Throws
/// InputError without four neck nodes.
[[nodiscard]] NeckTension neck_tension(const SectorMesh& sector, std::span<const Material> materials);

}  // namespace dovetail::fem
