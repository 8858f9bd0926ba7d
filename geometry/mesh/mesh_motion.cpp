#include "geometry/mesh/mesh_motion.hpp"

#include "geometry/mesh/section_reference.hpp"

namespace dovetail::geometry {

MeshFamily::MeshFamily(const ProfileParameters& reference, const MeshSizes& sizes, const MeshLimits& limits)
    : sizes_(checked(sizes)),
      limits_(limits),
      reference_(std::make_shared<const SectionReference>(reference, sizes_)) {}

MeshedSector MeshFamily::mesh_of(const ProfileParameters& parameters) const {
  return mesh_of(build_profile(parameters), parameters);
}

MeshedSector MeshFamily::mesh_of(const Profile& profile, const ProfileParameters& parameters) const {
  return mesh_section(reference_, profile, parameters, sizes_, limits_).plane;
}

MeshedSector mesh_sector(const ProfileParameters& parameters, const MeshSizes& sizes) {
  return MeshFamily(parameters, sizes).mesh_of(parameters);
}

}  // namespace dovetail::geometry
