#pragma once

#include <memory>

#include "geometry/mesh/mesh_motion.hpp"
#include "geometry/profile/parameters.hpp"
#include "geometry/solid/solid_parameters.hpp"

namespace dovetail::geometry {

struct SolidReference;

/// All solid sectors on one mesh topology: the plane mesh of MeshFamily, laid down at 2 slot_elements + 1 heights z
/// (ends and middles of the layers) and joined to 18-node wedges. At each height
///
/// - the disk is the plane mesh of the section with its slot shifted by z tan(skew) and its cuts, rim and bore turned
///   with it about the axis by z tan(skew)/rim_radius (slot_sweep.hpp): the cyclic images stay exact;
/// - the blade's root, shank and platform are the section shifted alike, so the flanks match node by node;
/// - the aerofoil, on the same layers, is that of aerofoil_form.hpp; platform and shank pass from the shifted section
///   into the aerofoil's foot with the weights of morph_weights.hpp, 0 up to the neck's upper end and at the
///   platform's sides. The end faces of the platform therefore follow the aerofoil's edges where the chord's axial
///   extent is not the slot's length. So one topology serves chords shorter and longer than the slot, and no
///   re-entrant edge appears at the leading edge's foot.
///
/// Weights and topology come from the reference alone, so positions are as smooth in all parameters as the profile.
/// Whether a design is meshed afresh is decided on its section as in MeshFamily; `quality` is that of the wedges.
///
/// Node i of the plane mesh at height l (0 the lowest z) is node l * (plane nodes) + i; see solid_layers.hpp.
class SolidFamily {
 public:
  /// Throws InputError when a size is out of range, the contact grid is finer than the mesh, or the boundary of the
  /// reference crosses itself.
  explicit SolidFamily(const ProfileParameters& reference, const MeshSizes& sizes = {}, const SolidSizes& along = {},
                       const MeshLimits& limits = {});

  /// May be called from several threads at once. Throws InputError when a parameter is out of range.
  [[nodiscard]] MeshedSector mesh_of(const ProfileParameters& parameters, const SolidParameters& solid) const;
  /// The same when the profile of these parameters is at hand.
  [[nodiscard]] MeshedSector mesh_of(const Profile& profile, const ProfileParameters& parameters,
                                     const SolidParameters& solid) const;

 private:
  MeshSizes sizes_;
  SolidSizes along_;
  MeshLimits limits_;
  std::shared_ptr<const SolidReference> reference_;
};

/// Mesh of a single design: the design is its own reference.
[[nodiscard]] MeshedSector mesh_solid(const ProfileParameters& parameters, const SolidParameters& solid,
                                      const MeshSizes& sizes = {}, const SolidSizes& along = {});

}  // namespace dovetail::geometry
