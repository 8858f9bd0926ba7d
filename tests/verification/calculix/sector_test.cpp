// The sector in space against CalculiX: 18-node wedges here, 15-node wedges there.
#include <gtest/gtest.h>

#include <array>

#include "geometry/exports/inp.hpp"
#include "geometry/solid_family.hpp"
#include "tests/verification/calculix/glued_joint.hpp"

namespace dovetail::calculix {
namespace {

constexpr double kSpeed = 1047.1975511965977;  // 10 000 rpm
constexpr std::array<int, 4> kDiameters{0, 1, 5, 23};
constexpr int kModes = 3;

geometry::MeshSizes coarse() {
  return {.flank_elements = 4, .fillet_fraction = 0.5, .bulk_size = 8e-3, .aerofoil_elements = 6};
}

/// A skewed slot and a twisted, tapered aerofoil, so that nothing is the same on two planes z = const.
fem::SectorMesh sector(int slot_elements) {
  const geometry::SolidParameters solid{.skew_angle = 0.17, .stagger = 0.2, .twist = 0.3, .tip_chord = 30e-3};
  return geometry::mesh_solid({}, solid, coarse(), {.slot_elements = slot_elements}).sector;
}

class SectorInCalculiX : public testing::Test {
 protected:
  void SetUp() override {
    if (!is_installed()) GTEST_SKIP() << "the program ccx is not installed (Debian package calculix-ccx)";
  }
};

TEST_F(SectorInCalculiX, HasOurNaturalFrequenciesOverNodalDiameters) {
  double coarser = 0;
  for (const int layers : {2, 4}) {
    const GluedJoint ours(sector(layers), kSpeed);
    const std::vector<int> diameters(kDiameters.begin(), layers == 2 ? kDiameters.begin() + 1 : kDiameters.end());
    const Answer answer =
        run(geometry::inp(ours.sector, ours.materials, {.nodal_diameters = diameters, .modes = kModes}));
    const double error = frequency_error(ours.frequencies(diameters, kModes, false), diameters, answer);
    RecordProperty("frequency_error_" + std::to_string(layers), std::to_string(error));
    if (layers == 2) coarser = error;
    if (layers == 4) {
      EXPECT_LT(error, 1e-3);
      EXPECT_LT(error, coarser);
    }
  }
}

TEST_F(SectorInCalculiX, HasOurCentrifugalStateAndFirstFrequencyAtSpeed) {
  constexpr std::array<int, 1> kOne{5};
  const GluedJoint ours(sector(4), kSpeed);
  const Answer answer = run(geometry::inp(ours.sector, ours.materials,
                                          {.speed = kSpeed, .nodal_diameters = {5}, .modes = 1, .tables = true}));
  const double displacement = ours.displacement_error(answer);
  const GluedJoint::StressErrors stress = ours.stress_errors(answer);
  const double frequency = frequency_error(ours.frequencies(kOne, 1, true), kOne, answer);
  RecordProperty("displacement_error", std::to_string(displacement));
  RecordProperty("largest_stress_error", std::to_string(stress.largest));
  RecordProperty("mean_stress_error", std::to_string(stress.mean));
  RecordProperty("frequency_error", std::to_string(frequency));
  EXPECT_LT(displacement, 5e-3);
  EXPECT_LT(stress.mean, 1.2e-2);
  EXPECT_LT(frequency, 1e-3);
}

}  // namespace
}  // namespace dovetail::calculix
