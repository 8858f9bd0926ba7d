#include "geometry/mesh/section_reference.hpp"

#include <fmt/format.h>

#include <numbers>
#include <utility>
#include <vector>

#include "core/errors.hpp"
#include "core/options.hpp"
#include "geometry/mesh/flank_fractions.hpp"

namespace dovetail::geometry {
namespace {

/// The design whose flanks are the mean of the given ones: mirror-symmetric.
ProfileParameters symmetric(ProfileParameters p) {
  const double angle = p.mean(&FlankParameters::angle), length = p.mean(&FlankParameters::length);
  for (FlankParameters& flank : p.flanks) {
    flank.angle = angle;
    flank.length = length;
  }
  return p;
}

}  // namespace

const MeshSizes& checked(const MeshSizes& sizes) {
  std::vector<Violation> found = violations(sizes, "mesh");
  if (!found.empty()) throw InputError(std::move(found));
  return sizes;
}

std::string figures(const MeshQuality& q) {
  return fmt::format("smallest scaled Jacobian {:.3f}, smallest angle {:.1f} degrees, {} inverted elements",
                     q.minimum_scaled_jacobian, q.minimum_angle * 180 / std::numbers::pi, q.inverted_elements);
}

ReferenceBody::ReferenceBody(const Chain& chain, const MeshSizes& sizes, const std::vector<double>& flank)
    : corners(mesh_corners(chain, sizes, flank)), motion(corners, prescribed_nodes(corners, chain).nodes) {}

Eigen::Matrix2Xd ReferenceBody::moved(const Chain& chain) const {
  return motion.positions(prescribed_nodes(corners, chain).positions);
}

SectionReference::SectionReference(const ProfileParameters& parameters, const MeshSizes& sizes)
    : SectionReference(build_profile(symmetric(parameters)), sizes, flank_fractions(parameters, sizes)) {}

SectionReference::SectionReference(const Profile& profile, const MeshSizes& sizes, const std::vector<double>& flank)
    : blade_chain(profile.blade),
      blade(profile.blade, sizes, flank),
      disk(profile.disk, sizes, flank),
      topology(blade.corners, disk.corners, profile) {}

MeshedSector SectionReference::mesh_of(const Profile& profile, const ProfileParameters& parameters) const {
  MeshedSector result;
  result.sector = topology.place(profile, parameters, blade.moved(profile.blade), disk.moved(profile.disk));
  result.quality = assess(result.sector.mesh);
  return result;
}

SectionMesh mesh_section(const std::shared_ptr<const SectionReference>& reference, const Profile& profile,
                         const ProfileParameters& parameters, const MeshSizes& sizes, const MeshLimits& limits) {
  MeshedSector moved = reference->mesh_of(profile, parameters);
  if (acceptable(moved.quality, limits)) {
    moved.note = "Moved from the reference: " + figures(moved.quality) + ".";
    return {reference, std::move(moved)};
  }
  const std::string reason =
      "The mesh of the reference does not stretch to this design (" + figures(moved.quality) + ")";
  try {
    auto own = std::make_shared<const SectionReference>(parameters, sizes);
    MeshedSector fresh = own->mesh_of(profile, parameters);
    if (fresh.quality.minimum_scaled_jacobian > moved.quality.minimum_scaled_jacobian) {
      fresh.remeshed = true;
      fresh.note = reason + ", so it was meshed afresh: " + figures(fresh.quality) + ".";
      return {std::move(own), std::move(fresh)};
    }
    moved.note = reason + " and meshing afresh is no better (" + figures(fresh.quality) + ").";
  } catch (const InputError& error) {
    moved.note = reason + " and it cannot be meshed afresh: " + error.what();
  }
  return {reference, std::move(moved)};
}

}  // namespace dovetail::geometry
