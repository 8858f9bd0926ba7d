// The whole chain in space on a straight sector held in plane strain, against the plane section: mesh, finite elements,
// stresses, reduction, preload, resonance, worn state.
#include <gtest/gtest.h>

#include <memory>
#include <utility>
#include <vector>

#include "fem/stress.hpp"
#include "geometry/solid/solid_family.hpp"
#include "optimizer/evaluator.hpp"
#include "reduction/static_condensation.hpp"
#include "tests/verification/fem/sector_model.hpp"
#include "tests/verification/optimizer/sector_joint.hpp"

namespace dovetail::optimizer {
namespace {

using testing::flank_loads;
using testing::FlankLoad;
using testing::joint;
using testing::longer;

/// The force on the aerofoil's tip acts on nodes with shares that sum to one.
struct Chain {
  Chain(fem::SectorMesh mesh, const Scene& scene, const std::vector<std::pair<int, double>>& tip, int modes)
      : sector(std::move(mesh)) {
    const std::vector<fem::Material> bodies = materials(scene);
    const fem::Assembler assembler(sector.mesh);
    system = fem::build_sector_system(sector, bodies, assembler);
    Eigen::VectorXd force = Eigen::VectorXd::Zero(system.full.dimensions * sector.mesh.node_count());
    for (const auto& [node, share] : tip) force(system.full.dimensions * node) = share;

    reduction::FullModel full = fem::testing::sector_model(system, scene.loading.speed, scene.contact.friction);
    const reduction::StaticCondensation still = reduction::condense_statically(full);
    const steady::Preload first = steady::quasi_static(std::make_shared<dynamics::CondensedModel>(still.model));
    const Eigen::VectorXd displacement =
        system.constraints.transformation * still.recovery.apply(first.displacement, first.force);
    const Eigen::SparseMatrix<double> geometric =
        assembler.geometric_stiffness(sector.mesh, fem::quadrature_stress(sector.mesh, bodies, displacement));
    full.stiffness =
        fem::constrain(fem::stiffness_at_speed(system.full, geometric, scene.loading.speed), system.constraints);
    full.outputs = system.constraints.transformation.transpose() * force;
    full.cosine_force = scene.loading.tip_force * full.outputs;
    reduction = reduction::reduce(full, {.modes = modes, .damping_ratio = scene.loading.damping_ratio});
    preload = steady::quasi_static(std::make_shared<dynamics::CondensedModel>(reduction.model));
    reduction.model.contact.slip_origin = preload.slip_origin;
    const auto condensed = std::make_shared<dynamics::CondensedModel>(reduction.model);

    const steady::Options steady = steady_options(scene.solver);
    unworn = paths::resonance({condensed, {}, steady}, reduction.glued_frequencies(0));
    wear::AsymptoteOptions options;
    options.arbitration = wear::Arbitration::never;
    options.certify_finer = false;
    worn = wear::asymptote({condensed, {}, steady}, unworn.omega, options, &unworn.state);
  }

  fem::SectorMesh sector;
  fem::SectorSystem system;
  reduction::Reduction reduction;
  steady::Preload preload;
  paths::Resonance unworn;
  wear::Asymptote worn;
};

/// One contact node along the slot for those of a grid: contact that is uniform along it.
fem::Flank uniform_along_the_slot(fem::Flank flank) {
  const auto across = static_cast<Eigen::Index>(flank.grid[0]);
  std::vector<Eigen::Triplet<double>> rows;
  for (int node = 0; node < flank.contact_count(); ++node) rows.emplace_back(node, node % flank.grid[0], 1);
  Eigen::SparseMatrix<double> same(flank.contact_count(), across);
  same.setFromTriplets(rows.begin(), rows.end());
  flank.interpolation = Eigen::SparseMatrix<double>(flank.interpolation * same);
  flank.position = Eigen::MatrixXd(flank.position.leftCols(across));
  if (flank.gap.size() > 0) flank.gap = Eigen::VectorXd(flank.gap.head(across));
  flank.grid[1] = 1;
  return flank;
}

/// All nodes held axially. (Those of the blade on a flank follow the disk's but for the relative sliding, which by
/// symmetry is none when contact is uniform along the slot.)
Chain held(const Scene& scene, int modes) {
  fem::SectorMesh solid = geometry::mesh_solid(scene.geometry, scene.solid, scene.mesh, scene.solid_mesh).sector;
  for (int node = 0; node < solid.mesh.node_count(); ++node) solid.axial_nodes.push_back(node);
  for (fem::Flank& flank : solid.flanks) flank = uniform_along_the_slot(flank);
  // A uniform line load on quadratic elements: Simpson's weights.
  const int levels = 2 * scene.solid_mesh.slot_elements + 1, plane_nodes = solid.mesh.node_count() / levels;
  std::vector<std::pair<int, double>> tip;
  for (int level = 0; level < levels; ++level) {
    const double weight = level % 2 == 1 ? 4 : (level == 0 || level == levels - 1 ? 1 : 2);
    tip.emplace_back(solid.tip_node % plane_nodes + plane_nodes * level, weight / (3 * (levels - 1)));
  }
  return Chain(std::move(solid), scene, tip, modes);
}

TEST(SectorHeldInPlaneStrain, IsTheSection) {
  Scene scene = joint(kSector);
  scene.solid_mesh.slot_elements = 2;
  // At three harmonics the answer depends a little on the pseudo-penalty, whose default is taken from the contact's own
  // stiffness: between modes that vary along the slot the same number of modes leaves another one.
  scene.solver.pseudo_penalty = 1e8;
  constexpr int kModes = 60;
  fem::SectorMesh plane = geometry::mesh_sector(scene.geometry, scene.mesh).sector;
  for (fem::Region& region : plane.mesh.regions) region.plane_stress = false;
  const Chain flat(plane, scene, {{plane.tip_node, 1}}, kModes);
  const std::vector<FlankLoad> flat_loads = flank_loads(flat.sector, flat.system, flat.preload);
  ASSERT_EQ(flat.preload.status, Status::converged);
  ASSERT_EQ(flat.unworn.status, Status::converged);
  ASSERT_EQ(flat.worn.verdict, wear::Verdict::asymptote);
  ASSERT_GT(flat.worn.largest_depth, 0);

  for (const int factor : {1, 2}) {
    Scene long_scene = longer(scene, factor);
    long_scene.solver.pseudo_penalty *= factor;
    const Chain deep = held(long_scene, kModes);
    ASSERT_EQ(deep.preload.status, Status::converged);
    ASSERT_EQ(deep.unworn.status, Status::converged);
    ASSERT_EQ(deep.worn.verdict, wear::Verdict::asymptote);
    // Static responses of the reduced models are exact: what is left is where the preloads stop, 1e-10 of the load.
    const std::vector<FlankLoad> loads = flank_loads(deep.sector, deep.system, deep.preload);
    for (std::size_t f = 0; f < 2; ++f) {
      const double mean = flat_loads[f].mean();
      EXPECT_LT((loads[f].pressure - flat_loads[f].pressure).cwiseAbs().maxCoeff(), 1e-7 * mean);
      EXPECT_NEAR(loads[f].tangential, factor * flat_loads[f].tangential, 1e-7 * mean * loads[f].area.sum());
      EXPECT_NEAR(loads[f].axial, 0, 1e-7 * mean * loads[f].area.sum());
    }
    // Of 60 modes a part varies along the slot, so the reductions differ: by 1e-8 in the glued frequency, and by some
    // hundred times as much at a resonance with a damping of 1e-3.
    EXPECT_NEAR(deep.unworn.omega, flat.unworn.omega, 1e-6 * flat.unworn.omega);
    EXPECT_NEAR(deep.unworn.amplitude, flat.unworn.amplitude, 2e-5 * flat.unworn.amplitude);
    const double energy = factor * flat.unworn.state.friction_energy;
    EXPECT_NEAR(deep.unworn.state.friction_energy, energy, 1e-4 * energy);
    EXPECT_NEAR(deep.worn.worn_volume, factor * flat.worn.worn_volume, 1e-5 * factor * flat.worn.worn_volume);
    EXPECT_LT((deep.worn.depth - flat.worn.depth).cwiseAbs().maxCoeff(), 1e-5 * flat.worn.largest_depth);
  }
}

}  // namespace
}  // namespace dovetail::optimizer
