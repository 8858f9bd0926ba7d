#include "geometry/mesh/mesh_motion.hpp"

#include "geometry/mesh/section_reference.hpp"

namespace dovetail::geometry {

struct MeshFamily::State {
  MeshSizes sizes;
  MeshLimits limits;
  std::shared_ptr<const SectionReference> reference;

  State(const ProfileParameters& parameters, const MeshSizes& s, const MeshLimits& l)
      : sizes(checked(s)), limits(l), reference(std::make_shared<const SectionReference>(parameters, sizes)) {}
};

MeshFamily::MeshFamily(const ProfileParameters& reference, const MeshSizes& sizes, const MeshLimits& limits)
    : state_(std::make_unique<const State>(reference, sizes, limits)) {}
MeshFamily::~MeshFamily() = default;
MeshFamily::MeshFamily(MeshFamily&&) noexcept = default;
MeshFamily& MeshFamily::operator=(MeshFamily&&) noexcept = default;

MeshedSector MeshFamily::mesh_of(const ProfileParameters& parameters) const {
  return mesh_of(build_profile(parameters), parameters);
}

MeshedSector MeshFamily::mesh_of(const Profile& profile, const ProfileParameters& parameters) const {
  return mesh_section(state_->reference, profile, parameters, state_->sizes, state_->limits).plane;
}

MeshedSector mesh_sector(const ProfileParameters& parameters, const MeshSizes& sizes) {
  return MeshFamily(parameters, sizes).mesh_of(parameters);
}

}  // namespace dovetail::geometry
