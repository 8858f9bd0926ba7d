// The frictional spin-up against CalculiX's surface-to-surface contact.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "geometry/exports/inp.hpp"
#include "geometry/mesh/mesh_motion.hpp"
#include "geometry/solid/solid_family.hpp"
#include "reduction/static_condensation.hpp"
#include "steady/preload.hpp"
#include "tests/verification/calculix/glued_joint.hpp"

namespace dovetail::calculix {
namespace {

constexpr double kFriction = 0.5;

/// Our spin-up with the stiffness at rest, as the geometrically linear step of the deck has it.
steady::Preload spin_up(const GluedJoint& joint) {
  const fem::SectorSystem& system = joint.system;
  const Eigen::Index count = system.contact.count(), directions = joint.sector.mesh.dimensions();
  reduction::FullModel full;
  full.stiffness = system.stiffness;
  full.mass = system.mass;
  full.static_force = kSpeed * kSpeed * system.centrifugal;
  full.cosine_force = full.sine_force = Eigen::MatrixXd::Zero(system.size(), 1);
  full.outputs = system.tip;
  full.output_names = {"tip_x"};
  full.contact.normal.resize(count);
  full.contact.tangential.resize(count, directions - 1);
  for (Eigen::Index i = 0; i < count; ++i) {
    full.contact.normal(i) = static_cast<int>(system.internal_size() + directions * i);
    for (Eigen::Index k = 1; k < directions; ++k)
      full.contact.tangential(i, k - 1) = full.contact.normal(i) + static_cast<int>(k);
  }
  full.contact.area = system.contact.area;
  full.contact.gap = system.contact.gap;
  full.contact.friction = Eigen::VectorXd::Constant(count, kFriction);
  full.contact.wear_coefficient = Eigen::VectorXd::Zero(count);
  full.contact.position = Eigen::MatrixX3d::Zero(count, 3);
  full.contact.position.leftCols(directions) = system.contact.position.transpose();
  full.contact.group = system.contact.flank;
  full.contact.slip_origin = Eigen::MatrixXd::Zero(count, directions - 1);
  const reduction::StaticCondensation condensed = reduction::condense_statically(full);
  return steady::quasi_static(std::make_shared<const dynamics::CondensedModel>(condensed.model));
}

/// Forces of one flank, N.
struct FlankForces {
  double normal = 0, shear = 0;
};
FlankForces forces_on(const GluedJoint& joint, const steady::Preload& preload, int flank) {
  const Eigen::Index directions = joint.sector.mesh.dimensions();
  FlankForces sum;
  Eigen::VectorXd shear = Eigen::VectorXd::Zero(directions - 1);
  for (Eigen::Index i = 0; i < joint.system.contact.count(); ++i)
    if (joint.system.contact.flank(i) == flank) {
      sum.normal += preload.force(directions * i);
      shear += preload.force.segment(directions * i + 1, directions - 1);
    }
  sum.shear = shear.norm();
  return sum;
}

fem::SectorMesh fine_section() {
  return geometry::mesh_sector(
             {}, {.flank_elements = 24, .fillet_fraction = 0.2, .bulk_size = 4e-3, .aerofoil_elements = 8})
      .sector;
}

class ContactInCalculiX : public testing::Test {
 protected:
  void SetUp() override {
    if (!is_installed()) GTEST_SKIP() << "the program ccx is not installed (Debian package calculix-ccx)";
  }
};

/// Root mean square of the differences of nodal pressures over the largest pressure, at contact nodes further than
/// `margin` (part of the flank, and of the slot in space) from its ends.
double pressure_error(const GluedJoint& ours, const steady::Preload& preload, const Answer& answer, double margin) {
  double squares = 0;
  int used = 0;
  Eigen::Index first = 0;  // contact node of the flank
  for (const fem::Flank& flank : ours.sector.flanks) {
    const Eigen::SparseMatrix<double>& weights = flank.interpolation;
    for (Eigen::Index i = 0; i < weights.cols(); ++i) {
      const auto near_an_end = [margin](Eigen::Index place, int count) {
        const double s = static_cast<double>(place) / (count - 1);
        return count > 1 && (s < margin || s > 1 - margin);
      };
      if (near_an_end(i % flank.grid[0], flank.grid[0]) || near_an_end(i / flank.grid[0], flank.grid[1])) continue;
      for (Eigen::SparseMatrix<double>::InnerIterator entry(weights, i); entry; ++entry) {
        if (entry.value() < 1 - 1e-9) continue;  // the pair at the contact node itself
        const int node = flank.pairs[static_cast<std::size_t>(entry.row())][0];
        squares += std::pow(answer.pressure.at(node) - preload.pressure(first + i), 2);
        ++used;
      }
    }
    first += weights.cols();
  }
  return std::sqrt(squares / used) / preload.pressure.maxCoeff();
}

/// Holds one joint against the other: resultants of both flanks, and pressures away from the ends.
void compare(const fem::SectorMesh& sector, int increments, double margin, double tolerance) {
  const GluedJoint ours(sector, kSpeed);
  const steady::Preload preload = spin_up(ours);
  ASSERT_EQ(preload.status, Status::converged);
  const Answer answer = run(geometry::inp(ours.sector, ours.materials,
                                          {.joint = geometry::FlankJoint::contact,
                                           .friction = kFriction,
                                           .speed = kSpeed,
                                           .increments = increments,
                                           .nodal_diameters = {},
                                           .tables = true}));
  ASSERT_GE(answer.normal_force.size(), 2U);
  for (int flank = 0; flank < 2; ++flank) {
    const FlankForces expected = forces_on(ours, preload, flank);
    const std::size_t last = answer.normal_force.size() - 2 + static_cast<std::size_t>(flank);
    const double normal = answer.normal_force[last] / expected.normal - 1;
    const double shear = answer.shear_force[last] / expected.shear - 1;
    ::testing::Test::RecordProperty("normal_error_" + std::to_string(flank), std::to_string(normal));
    ::testing::Test::RecordProperty("shear_error_" + std::to_string(flank), std::to_string(shear));
    EXPECT_NEAR(normal, 0, 2e-3);
    EXPECT_NEAR(shear, 0, 2e-3);
  }
  const double pressure = pressure_error(ours, preload, answer, margin);
  ::testing::Test::RecordProperty("pressure_error", std::to_string(pressure));
  EXPECT_LT(pressure, tolerance);
}

// Forces: equilibrium fixes the resultant of a flank but for its split into normal and shear, which the slide of the
// whole flank down its slope decides; all of it slips, so that shear = mu normal in both. CalculiX's contact is on
// springs (1e6 MPa/mm: 0.2 nm under 200 MPa) at points of the faces.
// Pressures: ours are linear between contact nodes, CalculiX's are extrapolated from points inside the faces to nodes;
// the peak at the end of the contact converges in neither, so the outer 15 % of a flank are left out.
TEST_F(ContactInCalculiX, CarriesOurForcesAndPressures) {
  compare(fine_section(), 10, 0.15, 9e-3);
}

/// Coarse: contact in space takes CalculiX a hundred times as long as in the plane.
fem::SectorMesh solid(double skew_angle) {
  const geometry::MeshSizes sizes{.flank_elements = 4,
                                  .fillet_fraction = 0.7,
                                  .bulk_size = 12e-3,
                                  .aerofoil_elements = 6,
                                  .blend_fraction = 0.8,
                                  .growth = 0.5};
  return geometry::mesh_solid({}, {.skew_angle = skew_angle}, sizes, {.slot_elements = 4}).sector;
}

// The same in space, where friction also acts along the slot. Measured: forces 0.07 % apart, pressures of the nodes
// inside a flank 2 % of the largest in a straight slot, 1.4 % in a skewed one, on four elements each way.
TEST_F(ContactInCalculiX, CarriesOurForcesAndPressuresInAStraightSlot) {
  compare(solid(0), 4, 0.15, 0.03);
}

TEST_F(ContactInCalculiX, CarriesOurForcesAndPressuresInASkewedSlot) {
  compare(solid(0.17), 4, 0.15, 0.03);
}

}  // namespace
}  // namespace dovetail::calculix
