#pragma once

#include <memory>
#include <string>

#include "fem/sector_mesh.hpp"
#include "geometry/mesh/mesh_quality.hpp"
#include "geometry/profile/parameters.hpp"
#include "geometry/profile/profile.hpp"

namespace dovetail::geometry {

/// The mesh of one design and how it came about.
struct MeshedSector {
  fem::SectorMesh sector;
  MeshQuality quality;    ///< inverted_elements > 0: not to be used (the design does not fit together)
  bool remeshed = false;  ///< the reference topology could not be stretched to this design
  std::string note;       ///< a sentence saying what was done and the quality figures
};

struct SectionReference;

/// All designs on one mesh topology. The topology, the division of the boundary and the element
/// sizes come from the reference design alone (made symmetric, so that the mesh is a mirror image of
/// itself). For another design, boundary nodes keep their fraction of their edge; the displacement
/// u of the interior corner nodes from the reference solves the linear elasticity problem
/// `K_ii u_i = -K_ib u_b` on the reference mesh, element stiffness proportional to 1/area so that
/// small elements are carried along rather than squeezed; mid-side nodes lie on the true curve (boundary)
/// or half-way between corners (interior). Positions are therefore as smooth in the parameters as the
/// profile is. The result depends on the reference and on the design only, never on designs meshed
/// before: any order of evaluation gives the same bits. A design on which the limits do not hold is
/// meshed with its own topology.
class MeshFamily {
 public:
  /// Cost: about 0.1 s with the default sizes. Throws InputError when a size is out of range or the
  /// boundary of the reference crosses itself.
  explicit MeshFamily(const ProfileParameters& reference, const MeshSizes& sizes = {}, const MeshLimits& limits = {});

  /// Cost: below 1 ms with the default sizes, 0.1 s more when meshed afresh. May be called from several threads at
  /// once.
  [[nodiscard]] MeshedSector mesh_of(const ProfileParameters& parameters) const;
  /// The same when the profile of these parameters is at hand.
  [[nodiscard]] MeshedSector mesh_of(const Profile& profile, const ProfileParameters& parameters) const;

 private:
  MeshSizes sizes_;
  MeshLimits limits_;
  std::shared_ptr<const SectionReference> reference_;
};

/// Mesh of a single design: the design is its own reference.
[[nodiscard]] MeshedSector mesh_sector(const ProfileParameters& parameters, const MeshSizes& sizes = {});

}  // namespace dovetail::geometry
