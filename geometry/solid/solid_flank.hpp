#pragma once

#include <vector>

#include "fem/sector_mesh.hpp"
#include "geometry/profile/flank_form.hpp"
#include "geometry/profile/parameters.hpp"
#include "geometry/solid/solid_parameters.hpp"

namespace dovetail::geometry {

/// The micrometre form of a blade flank over its whole surface: at s from 0 (neck side) to 1 (root side) across and at
/// u from 0 (lowest z) to 1 along the slot, measured along the normal,
///
///   g(s, u) = g(s) + axial_crown (2 u - 1)^2 + axial_relief_depth (relief(u) + relief(1 - u)) - c,
///
/// g(s) that of FlankForm, relief as there with axial_relief_length over the slot's own length
/// slot_length/cos(skew). c makes the smallest gap zero. (The sum separates: both parts have their own.)
class SolidFlankForm {
 public:
  SolidFlankForm(const FlankParameters& flank, const ProfileParameters& parameters, const SolidParameters& solid);

  /// Gap, m, >= 0.
  [[nodiscard]] double gap(double s, double u) const { return across_.gap(s) + along_.gap(u); }
  [[nodiscard]] const FlankForm& across() const { return across_; }
  [[nodiscard]] const FlankForm& along() const { return along_; }

 private:
  FlankForm across_, along_;
};

/// Fills what solid_layers left of the flanks, whose nodes are placed: directions (slot_sweep.hpp), the contact grid
/// with its positions and gaps, and the interpolation. Contact nodes divide a flank like the mesh's edges across the
/// slot and like the layers of elements along it; sizes of 0 give the mesh's own corner nodes. `plane`: the section, on
/// whose flanks pairs go from neck to root side, corners (at `fractions`) and mid-sides in turn.
void lay_contact(fem::SectorMesh& sector, const fem::SectorMesh& plane, const std::vector<double>& fractions,
                 const ProfileParameters& parameters, const SolidParameters& solid, const SolidSizes& sizes);

}  // namespace dovetail::geometry
