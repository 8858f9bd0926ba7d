#pragma once

#include <Eigen/Core>
#include <span>

#include "fem/material.hpp"
#include "fem/sector_mesh.hpp"

namespace dovetail::fem {

/// What the blade's neck carries for Omega^2 = 1; multiply by Omega^2.
struct NeckTension {
  Eigen::Vector2d force =
      Eigen::Vector2d::Zero();  ///< centrifugal pull of the blade above the section (x, y), N/(rad/s)^2
  double tension = 0;           ///< component normal to the section, N/(rad/s)^2
  double width = 0;             ///< m
  double thickness = 0;         ///< m
  double mean_stress = 0;       ///< tension / (width thickness), Pa/(rad/s)^2
  double mass = 0;              ///< of the blade above the section, kg
};

/// By equilibrium: nothing but the neck holds what is above it, so the section carries the integral of rho r t over
/// the blade (body 0) beyond the line through the two upper neck nodes. Elements crossed by the line are
/// clipped, so the result is continuous in the node positions. Throws InputError without four neck nodes.
[[nodiscard]] NeckTension neck_tension(const SectorMesh& sector, std::span<const Material> materials);

}  // namespace dovetail::fem
