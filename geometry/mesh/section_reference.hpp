#pragma once

#include <Eigen/Core>
#include <memory>
#include <string>

#include "geometry/mesh/corner_mesh.hpp"
#include "geometry/mesh/elastic_motion.hpp"
#include "geometry/mesh/mesh_motion.hpp"
#include "geometry/mesh/mesh_quality.hpp"
#include "geometry/mesh/sector_topology.hpp"
#include "geometry/profile/parameters.hpp"
#include "geometry/profile/profile.hpp"

namespace dovetail::geometry {

/// One body of a reference design and how its corner nodes follow its boundary.
struct ReferenceBody {
  CornerMesh corners;
  ElasticMotion motion;

  ReferenceBody(const Chain& chain, const MeshSizes& sizes, const std::vector<double>& flank);
  /// Positions [2, corners] when the boundary is `chain`.
  [[nodiscard]] Eigen::Matrix2Xd moved(const Chain& chain) const;
};

/// The mesh topology of one reference design, which every design on it shares. The design is made symmetric first
/// (both flanks the mean of the given ones), so that the mesh is a mirror image of itself.
struct SectionReference {
  Chain blade_chain;  ///< the reference blade's boundary
  ReferenceBody blade, disk;
  SectorTopology topology;

  SectionReference(const ProfileParameters& parameters, const MeshSizes& sizes);
  /// The plane mesh of another design. `profile` has the dimensions of `parameters`.
  [[nodiscard]] MeshedSector mesh_of(const Profile& profile, const ProfileParameters& parameters) const;

 private:
  SectionReference(const Profile& profile, const MeshSizes& sizes, const std::vector<double>& flank);
};

/// A reference on which a design meshes acceptably, and the plane mesh of the design.
struct SectionMesh {
  std::shared_ptr<const SectionReference> reference;  ///< that of the family, or the design's own
  MeshedSector plane;
};

/// Meshes the design on `reference`, or with its own topology where the limits do not hold; see MeshFamily.
[[nodiscard]] SectionMesh mesh_section(const std::shared_ptr<const SectionReference>& reference, const Profile& profile,
                                       const ProfileParameters& parameters, const MeshSizes& sizes,
                                       const MeshLimits& limits);

/// Throws InputError when a size is out of range.
[[nodiscard]] const MeshSizes& checked(const MeshSizes& sizes);

/// "smallest scaled Jacobian 0.412, smallest angle 21.3 degrees, 0 inverted elements"
[[nodiscard]] std::string figures(const MeshQuality& quality);

}  // namespace dovetail::geometry
