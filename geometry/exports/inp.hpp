#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "fem/constraints.hpp"
#include "fem/material.hpp"
#include "fem/sector_mesh.hpp"

namespace dovetail::geometry {

/// How the two flanks are joined in an input deck.
enum class FlankJoint {
  glued,    ///< equations between the matched nodes: no relative displacement, the blade glued to the disk
  contact,  ///< contact pairs with Coulomb friction; blade nodes moved back by the initial gap
};

/// What an input deck contains besides nodes, elements, sets and materials.
struct InpOptions {
  FlankJoint joint = FlankJoint::glued;
  double friction = 0.5;            ///< mu, >= 0; contact
  double contact_stiffness = 1e15;  ///< pressure per overlap of the contact pairs, Pa/m, > 0
  double stick_stiffness = 1e14;    ///< shear per tangential displacement of a sticking point, Pa/m, > 0
  bool cyclic_symmetry = true;      ///< false: the cuts are free
  fem::BoreSupport bore = fem::BoreSupport::tangential;
  double speed = 0;                     ///< Omega, rad/s, >= 0; 0: no static step, modes at rest
  int increments = 10;                  ///< of the static step with contact, >= 1
  std::vector<int> nodal_diameters{0};  ///< 0 ... sectors / 2 each; empty: no frequency step
  int modes = 10;                       ///< per nodal diameter, >= 1
  bool tables = false;  ///< displacements of nodes, stresses at integration points, contact forces as text (.dat)
};

/// The sector as an input deck of CalculiX (tried with 2.20; the keywords are Abaqus's). Units: mm, tonne, s, N, MPa.
///
/// A plane section becomes CPE6 or CPS6 with the regions' thickness, its cuts joined by equations in polar components,
/// as long as no nodal diameter but 0 is asked for. Cyclic symmetry with a phase takes no plane elements: then the
/// section becomes one layer of wedges with u_z = 0 (inp_layer.hpp), which is exactly plane strain.
/// 18-node wedges become C3D15, the largest wedge there is: the nodes in the middle of the rectangular faces are left
/// out. With displacements that do not depend on z that changes nothing; else the two interpolations converge to the
/// same answer.
///
/// Nodes and elements carry their index plus one. Sets: elements by region name, BLADE, DISK, ALL; nodes ALL, CUT_LEFT,
/// CUT_RIGHT, BORE, TIP, FILLETS, AXIAL, FLANK_LEFT_BLADE, FLANK_LEFT_DISK, FLANK_RIGHT_BLADE, FLANK_RIGHT_DISK;
/// element faces FLANK_LEFT_BLADE_FACES and so on.
///
/// Steps: at speed a static one with the centrifugal load (geometrically linear), then one of natural
/// frequencies per nodal diameter, as a perturbation of the former with its geometric stiffness, its deformed shape
/// and spin softening. CalculiX counts every mode of a model with cyclic symmetry twice, so twice as many are asked
/// for.
///
/// Throws InputError when an option is out of range, a material is missing, or a section with plane-stress regions is
/// asked for nodal diameters above 0.
[[nodiscard]] std::string inp(const fem::SectorMesh& sector, std::span<const fem::Material> materials,
                              const InpOptions& options = {});

/// Writes that deck beside its place and renames it. Throws InputError, also when it cannot be written.
void write_inp(const std::filesystem::path& file, const fem::SectorMesh& sector,
               std::span<const fem::Material> materials, const InpOptions& options = {});

}  // namespace dovetail::geometry
