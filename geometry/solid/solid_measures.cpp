#include "geometry/solid/solid_measures.hpp"

#include <array>
#include <utility>

#include "geometry/solid/aerofoil_form.hpp"
#include "geometry/solid/slot_sweep.hpp"

namespace dovetail::geometry {
namespace {

/// Gauss-Legendre on [-1, 1], ten points: abscissae and weights of the positive half.
constexpr std::array<std::pair<double, double>, 5> kGauss{{{0.1488743389816312, 0.2955242247147529},
                                                           {0.4333953941292472, 0.2692667193099963},
                                                           {0.6794095682990244, 0.2190863625159820},
                                                           {0.8650633666889845, 0.1494513491505806},
                                                           {0.9739065285171717, 0.0666713443086881}}};

}  // namespace

SolidVolumes solid_volumes(const ProfileParameters& parameters, const SolidParameters& solid) {
  const Profile profile = build_profile(parameters);
  SolidVolumes volumes;
  volumes.aerofoil = AerofoilForm(profile, parameters, solid).volume();
  const Edge& side = edge(profile.blade, "aerofoil_right");
  const double above = (side.start.x() + side.end.x()) * (side.end.y() - side.start.y());
  volumes.root = (area(profile.blade) - above) * parameters.slot_length;
  const double half = parameters.slot_length / 2;
  for (const auto& [place, weight] : kGauss)
    for (const double z : {-half * place, half * place})
      volumes.disk += half * weight * area(section_at(profile, parameters, solid, z).disk);
  return volumes;
}

SectorMass mass(const ProfileParameters& parameters, const SolidParameters& solid, double blade_density,
                double disk_density) {
  const SolidVolumes volumes = solid_volumes(parameters, solid);
  return {.blade = blade_density * (volumes.aerofoil + volumes.root), .disk = disk_density * volumes.disk};
}

}  // namespace dovetail::geometry
