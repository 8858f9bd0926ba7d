#include "geometry/solid/solid_family.hpp"

#include <cmath>
#include <utility>
#include <vector>

#include "geometry/mesh/flank_fractions.hpp"
#include "geometry/mesh/section_reference.hpp"
#include "geometry/solid/aerofoil_form.hpp"
#include "geometry/solid/morph_weights.hpp"
#include "geometry/solid/slot_sweep.hpp"
#include "geometry/solid/solid_flank.hpp"
#include "geometry/solid/solid_layers.hpp"

namespace dovetail::geometry {

/// A reference with what the solid needs of it besides.
struct SolidReference {
  std::shared_ptr<const SectionReference> section;
  Eigen::VectorXd chord, thickness;  // [plane nodes], see morph_weights.hpp
  std::vector<bool> aerofoil;        // [plane nodes]

  SolidReference(std::shared_ptr<const SectionReference> reference, const fem::Mesh& plane)
      : section(std::move(reference)), aerofoil(static_cast<std::size_t>(plane.node_count()), false) {
    const MorphWeights weights = morph_weights(section->blade.corners, section->blade_chain);
    chord = section->topology.blade_values(weights.chord);
    thickness = section->topology.blade_values(weights.thickness);
    for (int e = 0; e < plane.element_count(); ++e)
      if (plane.region_of(e).name == "aerofoil")
        for (const int node : plane.element(e)) aerofoil[static_cast<std::size_t>(node)] = true;
  }
};

namespace {

/// One design on its way from the section to the solid.
class Sweep {
 public:
  Sweep(const SolidReference& reference, const fem::Mesh& plane, const Profile& profile,
        const ProfileParameters& parameters, const SolidParameters& solid)
      : reference_(reference),
        plane_(plane),
        profile_(profile),
        parameters_(parameters),
        solid_(solid),
        aerofoil_(profile, parameters, solid),
        blade_corners_(reference.section->blade.moved(profile.blade)) {}

  /// Positions [3, plane nodes] at height z.
  [[nodiscard]] Eigen::Matrix3Xd at(double z) const {
    const Profile section = section_at(profile_, parameters_, solid_, z);
    const double shift = z * std::tan(solid_.skew_angle), eta = 2 * z / parameters_.slot_length;
    Eigen::Matrix2Xd blade = blade_corners_;
    blade.row(0).array() += shift;
    const Eigen::Matrix2Xd flat =
        reference_.section->topology.positions(section, blade, reference_.section->disk.moved(section.disk));
    Eigen::Matrix3Xd nodes(3, flat.cols());
    nodes.topRows<2>() = flat;
    nodes.row(2).setConstant(z);
    for (Eigen::Index i = 0; i < nodes.cols(); ++i) {
      const double weight = reference_.chord[i];
      if (weight == 0) continue;
      const bool aerofoil = reference_.aerofoil[static_cast<std::size_t>(i)];
      const double s = aerofoil ? aerofoil_.span_fraction(flat(1, i)) : 0;
      const double xi = plane_.nodes(0, i);
      // Platform and shank turn with the aerofoil but do not get thinner with it.
      const double thickness = aerofoil ? xi : aerofoil_.half_root_thickness() * reference_.thickness[i];
      const double lost = thickness * (1 - aerofoil_.fullness(eta));
      const Eigen::Vector2d chord = aerofoil_.chord_point(s, eta), across = aerofoil_.across(s);
      nodes(0, i) += weight * (chord.x() - shift + xi * (across.x() - 1)) - lost * across.x();
      // Square: an axial displacement that fades sooner keeps the platform's end faces flatter.
      nodes(2, i) += weight * (chord.y() - z) + (weight * weight * xi - lost) * across.y();
    }
    return nodes;
  }

 private:
  const SolidReference& reference_;
  const fem::Mesh& plane_;
  const Profile& profile_;
  const ProfileParameters& parameters_;
  const SolidParameters& solid_;
  AerofoilForm aerofoil_;
  Eigen::Matrix2Xd blade_corners_;
};

MeshedSector swept(const SolidReference& reference, const MeshedSector& plane, const Profile& profile,
                   const ProfileParameters& parameters, const SolidParameters& solid, const SolidSizes& sizes) {
  MeshedSector result;
  result.remeshed = plane.remeshed;
  result.sector = solid_layers(plane.sector, sizes.slot_elements);
  const Sweep sweep(reference, plane.sector.mesh, profile, parameters, solid);
  const std::vector<double> heights =
      with_middles(layer_ends(parameters.slot_length, sizes.slot_elements, sizes.slot_grading));
  const Eigen::Index count = plane.sector.mesh.node_count();
  fem::Mesh& mesh = result.sector.mesh;
  mesh.nodes.resize(3, count * static_cast<Eigen::Index>(heights.size()));
  for (std::size_t l = 0; l < heights.size(); ++l)
    mesh.nodes.middleCols(count * static_cast<Eigen::Index>(l), count) = sweep.at(heights[l]);
  lay_contact(result.sector, plane.sector, reference.section->topology.flank_fractions(), parameters, solid, sizes);
  result.quality = assess(mesh);
  result.note = plane.note + " Its sweep: " + figures(result.quality) + ".";
  return result;
}

}  // namespace

SolidFamily::SolidFamily(const ProfileParameters& reference, const MeshSizes& sizes, const SolidSizes& along,
                         const MeshLimits& limits)
    : sizes_(checked(sizes)), along_(checked(along, sizes)), limits_(limits) {
  auto section = std::make_shared<const SectionReference>(reference, sizes_);
  const MeshedSector plane = section->mesh_of(build_profile(reference), reference);
  reference_ = std::make_shared<const SolidReference>(std::move(section), plane.sector.mesh);
}

MeshedSector SolidFamily::mesh_of(const ProfileParameters& parameters, const SolidParameters& solid) const {
  return mesh_of(build_profile(parameters), parameters, solid);
}

MeshedSector SolidFamily::mesh_of(const Profile& profile, const ProfileParameters& parameters,
                                  const SolidParameters& solid) const {
  const SectionMesh section = mesh_section(reference_->section, profile, parameters, sizes_, limits_);
  if (section.reference == reference_->section)
    return swept(*reference_, section.plane, profile, parameters, checked(solid), along_);
  const SolidReference own(section.reference, section.plane.sector.mesh);
  return swept(own, section.plane, profile, parameters, checked(solid), along_);
}

MeshedSector mesh_solid(const ProfileParameters& parameters, const SolidParameters& solid, const MeshSizes& sizes,
                        const SolidSizes& along) {
  return SolidFamily(parameters, sizes, along).mesh_of(parameters, solid);
}

}  // namespace dovetail::geometry
