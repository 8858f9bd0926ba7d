// The sector in space against CalculiX: 18-node wedges here, 15-node wedges there.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <numeric>

#include "geometry/exports/inp.hpp"
#include "geometry/solid/solid_family.hpp"
#include "tests/verification/calculix/glued_joint.hpp"

namespace dovetail::calculix {
namespace {

constexpr int kModes = 3;

geometry::MeshSizes coarse() {
  return {.flank_elements = 4, .fillet_fraction = 0.5, .bulk_size = 8e-3, .aerofoil_elements = 6};
}

/// A skewed slot and a twisted, tapered aerofoil, so that nothing is the same on two planes z = const.
fem::SectorMesh skewed_sector(int slot_elements) {
  const geometry::SolidParameters solid{.skew_angle = 0.17, .stagger = 0.2, .twist = 0.3, .tip_chord = 30e-3};
  return geometry::mesh_solid({}, solid, coarse(), {.slot_elements = slot_elements}).sector;
}

/// A straight one with u_z = 0 everywhere: displacements do not depend on z, and both wedges can say so exactly.
fem::SectorMesh plane_strain_sector() {
  const geometry::MeshSizes sizes{
      .flank_elements = 8, .fillet_fraction = 0.3, .bulk_size = 6e-3, .aerofoil_elements = 8};
  fem::SectorMesh sector = geometry::mesh_solid({}, {}, sizes, {.slot_elements = 2}).sector;
  sector.axial_nodes.resize(static_cast<std::size_t>(sector.mesh.node_count()));
  std::iota(sector.axial_nodes.begin(), sector.axial_nodes.end(), 0);
  return sector;
}

class SectorInCalculiX : public testing::Test {
 protected:
  void SetUp() override {
    if (!is_installed()) GTEST_SKIP() << "the program ccx is not installed (Debian package calculix-ccx)";
  }
};

// Where both elements interpolate alike: what is left are three points of integration in the plane instead of six.
TEST_F(SectorInCalculiX, HasOurStateAndFrequenciesWhereTheElementsAreEquivalent) {
  constexpr std::array<int, 1> kOne{5};
  const GluedJoint ours(plane_strain_sector(), kSpeed);
  const Answer state =
      run(geometry::inp(ours.sector, ours.materials, {.speed = kSpeed, .nodal_diameters = {}, .tables = true}));
  const Answer rest = run(geometry::inp(ours.sector, ours.materials, {.nodal_diameters = {5}, .modes = kModes}));
  const double displacement = ours.displacement_error(state);
  const GluedJoint::StressErrors stress = ours.stress_errors(state);
  const double frequency = frequency_error(ours.frequencies(kOne, kModes, false), kOne, rest);
  RecordProperty("displacement_error", std::to_string(displacement));
  RecordProperty("largest_stress_error", std::to_string(stress.largest));
  RecordProperty("mean_stress_error", std::to_string(stress.mean));
  RecordProperty("frequency_error", std::to_string(frequency));
  EXPECT_LT(displacement, 2e-5);
  EXPECT_LT(stress.largest, 5e-3);
  EXPECT_LT(frequency, 3e-4);
}

// Everywhere else two interpolations approach one answer: layers along the slot halve their distance.
TEST_F(SectorInCalculiX, HasOurNaturalFrequenciesOverNodalDiameters) {
  double coarser = 0;
  for (const int layers : {2, 3}) {
    const GluedJoint ours(skewed_sector(layers), kSpeed);
    const std::vector<int> diameters(kDiameters.begin(), layers == 2 ? kDiameters.begin() + 1 : kDiameters.end());
    const Answer answer =
        run(geometry::inp(ours.sector, ours.materials, {.nodal_diameters = diameters, .modes = kModes}));
    const double error = frequency_error(ours.frequencies(diameters, kModes, false), diameters, answer);
    RecordProperty("frequency_error_" + std::to_string(layers), std::to_string(error));
    if (layers == 2)
      coarser = error;
    else
      EXPECT_LT(error, std::min(1e-3, coarser));
  }
}

// Root mean square distance of the stresses: 1.2, 1.0, 0.8 % with 2, 4, 8 layers on this coarse section (two elements
// to a fillet), 0.7 and 0.6 % with 8 and 14 layers on one 1.6 times as fine; displacements are 0.1 % apart on all.
TEST_F(SectorInCalculiX, HasOurCentrifugalStateAndFirstFrequencyAtSpeed) {
  constexpr std::array<int, 1> kOne{5};
  GluedJoint::StressErrors coarser;
  for (const int layers : {2, 4}) {
    const GluedJoint ours(skewed_sector(layers), kSpeed);
    const std::vector<int> diameters(layers == 2 ? 0 : 1, kOne[0]);
    const Answer answer = run(geometry::inp(
        ours.sector, ours.materials, {.speed = kSpeed, .nodal_diameters = diameters, .modes = 1, .tables = true}));
    const double displacement = ours.displacement_error(answer);
    const GluedJoint::StressErrors stress = ours.stress_errors(answer);
    RecordProperty("displacement_error_" + std::to_string(layers), std::to_string(displacement));
    RecordProperty("largest_stress_error_" + std::to_string(layers), std::to_string(stress.largest));
    RecordProperty("mean_stress_error_" + std::to_string(layers), std::to_string(stress.mean));
    if (layers == 2) {
      coarser = stress;
      continue;
    }
    EXPECT_LT(displacement, 2e-3);
    EXPECT_LT(stress.mean, std::min(1.2e-2, coarser.mean));
    const double frequency = frequency_error(ours.frequencies(kOne, 1, true), kOne, answer);
    RecordProperty("frequency_error", std::to_string(frequency));
    EXPECT_LT(frequency, 4e-4);
  }
}

}  // namespace
}  // namespace dovetail::calculix
