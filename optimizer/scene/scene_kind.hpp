#pragma once

#include <functional>
#include <limits>
#include <span>
#include <string_view>
#include <vector>

#include "fem/mesh.hpp"
#include "geometry/mesh/mesh_motion.hpp"
#include "geometry/rules/feasibility.hpp"
#include "optimizer/scene/scene.hpp"

namespace dovetail::optimizer {

/// Meshes designs on one topology.
using Mesher = std::function<geometry::MeshedSector(const Scene&)>;

/// How much of the sector a scene models, and everything that depends on it. A study file may give every key whatever
/// the kind; those that have no meaning for it are kept and left aside.
struct SceneKind {
  std::string_view name, meaning;  ///< scene.type of a study file, and what it says there
  /// The rules of a design.
  geometry::Feasibility (*feasibility)(const Scene& scene, const geometry::FeasibilityLimits& limits);
  /// On the topology of the reference, which with its sizes is all that counts of it. Throws InputError when the
  /// reference cannot be meshed. Meshing may be called from several threads.
  Mesher (*mesher)(const Scene& reference);
  double (*blade_mass)(const Scene& scene, const fem::Mesh& mesh);  ///< kg
  /// What contradicts between keys that have a meaning for this kind alone.
  std::vector<Violation> (*contradictions)(const Scene& scene);

  std::span<const std::string_view> counts;  ///< keys of numbers of elements, which another mesh has more or fewer of
  std::span<const std::string_view> layers;  ///< those of them along the slot
  std::span<const std::string_view> beside;  ///< those of them beside the flanks, where these have sizes of their own
  std::span<const std::string_view>
      lengths;          ///< keys of sizes of elements beside the flanks, which it has larger or smaller
  int finer_below;      ///< edges along the flanks from which on coarser meshes say what finer ones would; 0: always
  bool contact_grid;    ///< mesh.contact_flank_elements and mesh.contact_slot_elements count
  bool rough_peaks;     ///< the mesh is known to resolve the pressure at the ends of rough flanks
  bool coarse_answers;  ///< a coarser mesh says what harmonics, samples and penalties leave open
  bool in_space;        ///< responses converge as in space, and the aerofoil is one
  int finer_meshes = std::numeric_limits<int>::max();  ///< optimizer.finer_meshes by default, at most
};

/// Every kind. A new one is a file beside section.cpp, and an entry here.
[[nodiscard]] std::span<const SceneKind* const> scene_kinds();

/// The plane of rotation: plane strain, all of the slot alike.
extern const SceneKind kSection;
/// The sector in space: the section swept along the slot.
extern const SceneKind kSector;

}  // namespace dovetail::optimizer
