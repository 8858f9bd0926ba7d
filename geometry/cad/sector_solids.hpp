#pragma once

#include <array>
#include <filesystem>
#include <memory>
#include <vector>

#include "geometry/cad/worn_flank.hpp"
#include "geometry/exports/stl.hpp"
#include "geometry/profile/parameters.hpp"
#include "geometry/solid/solid_parameters.hpp"

namespace dovetail::geometry {

/// What solids are made of.
struct SolidDesign {
  ProfileParameters profile;
  SolidParameters solid = {};                       ///< of a plane section: the default
  std::array<WornFlank, kFlanks.size()> worn = {};  ///< what the blade's flanks have lost, in the order of kFlanks
};

/// Blade and disk of one sector as solids with exact faces (boundary representation), z the axis of rotation, the
/// middle of the slot at z = 0.
///
/// - Lines and arcs of the section stay planes and, in a straight slot, cylinders; in a skewed one they are swept along
///   the slot's direction, arcs as true circles.
/// - The blade has the form of its flanks: the lines and arcs of finished_blade. A flank that is worn, or whose form
///   changes along the slot, is a spline, see FlankDepth; all of the wear is the blade's. Beside it fillet and corner
///   are drawn again as in finished_blade, or, where that changes along the slot, moved along the flank's normal by
///   its depth times 1 - 3 t^2 + 2 t^3, t from 0 to 1 along the arc: splines.
/// - A straight aerofoil without skew is the section's, with its blends, over the chord; the rest of the blade is as
///   long as the slot. Any other is the AerofoilForm continued down to the platform as a spline, without the blends,
///   on a platform that is the section swept: the platform of the mesh follows the aerofoil's foot instead.
/// - In a skewed slot bore, rim and cuts of the disk turn about the axis as in section_at: the cuts are helicoids.
///
/// Splines other than worn flanks (twisted aerofoils, helicoids, moved arcs) follow what they stand for to within 1e-9
/// of its radius.
class SectorSolids {
 public:
  /// Throws InputError for a design that cannot be drawn, and where the modeller makes no valid solid of it.
  explicit SectorSolids(const SolidDesign& design);

  /// Products BLADE and DISK, AP214, mm. Throws InputError when the file cannot be written.
  void write_step(const std::filesystem::path& file) const;
  /// The same as solids of IGES 5.3 (entities 186), mm.
  void write_iges(const std::filesystem::path& file) const;

  /// The surfaces of blade and disk in flat triangles, counter-clockwise seen from outside, m: no farther than
  /// `deviation`, m, from the faces, and turning by no more than `turn`, rad, from one to the next.
  [[nodiscard]] std::array<std::vector<Triangle>, 2> triangles(double deviation = 2e-6, double turn = 0.1) const;

 private:
  struct Shapes;
  std::shared_ptr<const Shapes> shapes_;
};

}  // namespace dovetail::geometry
