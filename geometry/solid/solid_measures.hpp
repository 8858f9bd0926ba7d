#pragma once

#include "geometry/profile/measures.hpp"
#include "geometry/solid/solid_parameters.hpp"

namespace dovetail::geometry {

/// Volumes of one solid sector, m3. Disk and aerofoil exactly (the disk's section turns with a skewed slot, so its
/// area varies a little along z: Gauss's rule of ten points); root, shank and platform as their section times
/// slot_length, which leaves out what the platform gains or loses on its way into the aerofoil's foot (a few per cent
/// of the blade; measure_of_body of the mesh has it).
struct SolidVolumes {
  double aerofoil = 0;  ///< above its blends
  double root = 0;      ///< the rest of the blade
  double disk = 0;
};
[[nodiscard]] SolidVolumes solid_volumes(const ProfileParameters& parameters, const SolidParameters& solid);

/// Mass of one blade and one sector of the disk from these volumes; densities in kg/m3.
[[nodiscard]] SectorMass mass(const ProfileParameters& parameters, const SolidParameters& solid, double blade_density,
                              double disk_density);

}  // namespace dovetail::geometry
