#include "geometry/solid/solid_flank.hpp"

#include <cassert>
#include <cmath>
#include <vector>

#include "geometry/mesh/contact_grid.hpp"
#include "geometry/mesh/flank_fractions.hpp"
#include "geometry/solid/slot_sweep.hpp"

namespace dovetail::geometry {
namespace {

FlankParameters along_slot(const ProfileParameters& parameters, const SolidParameters& solid) {
  return {.length = parameters.slot_length / std::cos(solid.skew_angle),
          .crown = solid.axial_crown,
          .relief_length = solid.axial_relief_length,
          .relief_depth = solid.axial_relief_depth};
}

}  // namespace

SolidFlankForm::SolidFlankForm(const FlankParameters& flank, const ProfileParameters& parameters,
                               const SolidParameters& solid)
    : across_(flank), along_(along_slot(parameters, solid)) {}

void lay_contact(fem::SectorMesh& sector, const fem::SectorMesh& plane, const std::vector<double>& fractions,
                 const ProfileParameters& parameters, const SolidParameters& solid, const SolidSizes& sizes) {
  const fem::Mesh& mesh = sector.mesh;
  const std::vector<double> pairs_across = with_middles(fractions);
  const std::vector<double> across =
      sizes.contact_flank_elements > 0 ? divided_like(fractions, sizes.contact_flank_elements) : fractions;
  const int parts = sizes.contact_slot_elements > 0 ? sizes.contact_slot_elements : sizes.slot_elements;
  const std::vector<double> along = layer_ends(parameters.slot_length, parts, sizes.slot_grading);
  for (std::size_t f = 0; f < kFlanks.size(); ++f) {
    fem::Flank& flank = sector.flanks[f];
    const fem::Flank& section = plane.flanks[f];
    assert(section.pairs.size() == pairs_across.size());
    const FlankFrame frame = flank_frame(section.tangents.col(0), kFlanks[f].left, solid.skew_angle);
    flank.normal = frame.normal;
    flank.tangents = frame.tangents;

    std::vector<double> heights;
    for (std::size_t row = 0; row < flank.pairs.size(); row += section.pairs.size())
      heights.push_back(mesh.nodes(2, flank.pairs[row][0]));
    flank.grid = {static_cast<int>(across.size()), static_cast<int>(along.size())};
    flank.interpolation = bilinear_interpolation(across, along, pairs_across, heights);

    const Eigen::Vector2d neck = mesh.nodes.col(flank.pairs.front()[0]).head<2>();
    const Eigen::Vector2d root = mesh.nodes.col(flank.pairs[section.pairs.size() - 1][0]).head<2>();
    const SolidFlankForm form(parameters.flanks[f], parameters, solid);
    flank.position.resize(3, flank.contact_count());
    flank.gap.resize(flank.contact_count());
    Eigen::Index node = 0;
    for (const double z : along)
      for (const double s : across) {
        flank.position.col(node) << neck + s * (root - neck), z;
        flank.position(0, node) += (z - along.front()) * std::tan(solid.skew_angle);
        flank.gap[node++] = form.gap(s, z / parameters.slot_length + 0.5);
      }
    flank.pair_gap.resize(std::ssize(flank.pairs));
    Eigen::Index pair = 0;
    for (const double z : heights)
      for (const double s : pairs_across) flank.pair_gap[pair++] = form.gap(s, z / parameters.slot_length + 0.5);
  }
}

}  // namespace dovetail::geometry
