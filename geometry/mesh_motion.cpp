#include "geometry/mesh_motion.hpp"

#include <fmt/format.h>

#include <numbers>
#include <utility>

#include "core/errors.hpp"
#include "core/options.hpp"
#include "geometry/corner_mesh.hpp"
#include "geometry/elastic_motion.hpp"
#include "geometry/sector_topology.hpp"

namespace dovetail::geometry {
namespace {

/// The design whose two flanks are the mean of the given ones: mirror-symmetric.
ProfileParameters symmetric(ProfileParameters p) {
  p.left.angle = p.right.angle = (p.left.angle + p.right.angle) / 2;
  p.left.length = p.right.length = (p.left.length + p.right.length) / 2;
  return p;
}

const MeshSizes& checked(const MeshSizes& sizes) {
  std::vector<Violation> found = violations(sizes, "mesh");
  if (!found.empty()) throw InputError(std::move(found));
  return sizes;
}

std::string figures(const MeshQuality& q) {
  return fmt::format("smallest scaled Jacobian {:.3f}, smallest angle {:.1f} degrees, {} inverted elements",
                     q.minimum_scaled_jacobian, q.minimum_angle * 180 / std::numbers::pi, q.inverted_elements);
}

/// One body of the reference and how it follows its boundary.
struct Body {
  CornerMesh corners;
  ElasticMotion motion;

  Body(const Chain& chain, const MeshSizes& sizes)
      : corners(mesh_corners(chain, sizes)), motion(corners, prescribed_nodes(corners, chain).nodes) {}
  [[nodiscard]] Eigen::Matrix2Xd moved(const Chain& chain) const {
    return motion.positions(prescribed_nodes(corners, chain).positions);
  }
};

/// The topology of one reference design.
struct Reference {
  Body blade, disk;
  SectorTopology topology;

  Reference(const Profile& profile, const MeshSizes& sizes)
      : blade(profile.blade, sizes), disk(profile.disk, sizes), topology(blade.corners, disk.corners, profile) {}

  [[nodiscard]] MeshedSector mesh_of(const Profile& profile, const ProfileParameters& parameters) const {
    MeshedSector result;
    result.sector = topology.place(profile, parameters, blade.moved(profile.blade), disk.moved(profile.disk));
    result.quality = assess(result.sector.mesh);
    return result;
  }
};

}  // namespace

struct MeshFamily::State {
  MeshSizes sizes;
  MeshLimits limits;
  Reference reference;

  State(const ProfileParameters& parameters, const MeshSizes& s, const MeshLimits& l)
      : sizes(checked(s)), limits(l), reference(build_profile(symmetric(parameters)), sizes) {}
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
  MeshedSector moved = state_->reference.mesh_of(profile, parameters);
  if (acceptable(moved.quality, state_->limits)) {
    moved.note = "Moved from the reference: " + figures(moved.quality) + ".";
    return moved;
  }
  const std::string reason =
      "The mesh of the reference does not stretch to this design (" + figures(moved.quality) + ")";
  try {
    const Reference own(build_profile(symmetric(parameters)), state_->sizes);
    MeshedSector fresh = own.mesh_of(profile, parameters);
    if (fresh.quality.minimum_scaled_jacobian > moved.quality.minimum_scaled_jacobian) {
      fresh.remeshed = true;
      fresh.note = reason + ", so it was meshed afresh: " + figures(fresh.quality) + ".";
      return fresh;
    }
    moved.note = reason + " and meshing afresh is no better (" + figures(fresh.quality) + ").";
  } catch (const InputError& error) {
    moved.note = reason + " and it cannot be meshed afresh: " + error.what();
  }
  return moved;
}

MeshedSector mesh_sector(const ProfileParameters& parameters, const MeshSizes& sizes) {
  return MeshFamily(parameters, sizes).mesh_of(parameters);
}

}  // namespace dovetail::geometry
