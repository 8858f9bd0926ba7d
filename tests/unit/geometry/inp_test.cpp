#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <sstream>

#include "core/errors.hpp"
#include "geometry/exports/inp.hpp"
#include "geometry/exports/inp_layer.hpp"
#include "geometry/mesh/mesh_motion.hpp"
#include "geometry/profile/flank_form.hpp"

namespace dovetail::geometry {
namespace {

using testing::HasSubstr;
using testing::Not;

const std::vector<fem::Material> kMaterials{{.youngs_modulus = 114e9, .poisson_ratio = 0.33, .density = 4430},
                                            {.youngs_modulus = 2e11, .poisson_ratio = 0.3, .density = 7800}};

fem::SectorMesh section(const ProfileParameters& parameters = {}) {
  return mesh_sector(parameters,
                     {.flank_elements = 4, .fillet_fraction = 0.5, .bulk_size = 8e-3, .aerofoil_elements = 4})
      .sector;
}

/// The nodes of a deck, mm, by their number in it.
std::map<int, Eigen::Vector3d> nodes_of(const std::string& deck) {
  std::map<int, Eigen::Vector3d> nodes;
  std::istringstream lines(deck.substr(deck.find("*NODE,NSET=ALL\n") + 15));
  std::string line;
  while (std::getline(lines, line) && line[0] != '*') {
    std::istringstream row(line);
    int number = 0;
    char comma = 0;
    Eigen::Vector3d at;
    row >> number >> comma >> at[0] >> comma >> at[1] >> comma >> at[2];
    nodes[number] = at;
  }
  return nodes;
}

TEST(InputDeck, HasThePlaneMeshInMillimetresWithItsSets) {
  const fem::SectorMesh sector = section();
  const std::string deck = inp(sector, kMaterials, {.speed = 1000});
  const std::map<int, Eigen::Vector3d> nodes = nodes_of(deck);
  ASSERT_EQ(nodes.size(), static_cast<std::size_t>(sector.mesh.node_count()));
  for (const auto& [number, at] : nodes)
    EXPECT_LT((at.head<2>() - 1e3 * sector.mesh.nodes.col(number - 1)).norm(), 1e-9);
  for (const char* set : {"CUT_LEFT", "CUT_RIGHT", "BORE", "TIP", "FILLETS", "FLANK_LEFT_BLADE", "FLANK_RIGHT_DISK"})
    EXPECT_THAT(deck, HasSubstr(std::string("*NSET,NSET=") + set + "\n"));
  for (const char* set : {"TYPE=CPE6,ELSET=BLADE_ROOT", "TYPE=CPE6,ELSET=DISK", "*ELSET,ELSET=BLADE\n",
                          "*SURFACE,NAME=FLANK_LEFT_BLADE_FACES,TYPE=ELEMENT"})
    EXPECT_THAT(deck, HasSubstr(set));
  EXPECT_THAT(deck, HasSubstr("*MATERIAL,NAME=DISK\n*ELASTIC\n200000,0.3\n*DENSITY\n7.8e-09\n"));
  EXPECT_THAT(deck, HasSubstr("CENTRIF,1000000,0,0,0,0,0,1"));
  EXPECT_THAT(deck, Not(HasSubstr("*CONTACT PAIR")));
}

TEST(InputDeck, LeavesTheFaceCentresOfWedgesOut) {
  const fem::SectorMesh layer = inp_layer(section());
  const std::string deck = inp(layer, kMaterials, {.nodal_diameters = {3}});
  EXPECT_THAT(deck, HasSubstr("*ELEMENT,TYPE=C3D15,ELSET=AEROFOIL"));
  EXPECT_THAT(deck, HasSubstr("*SELECT CYCLIC SYMMETRY MODES,NMIN=3,NMAX=3"));
  const std::map<int, Eigen::Vector3d> nodes = nodes_of(deck);
  for (int e = 0; e < layer.mesh.element_count(); ++e)
    for (int k = 0; k < 18; ++k)
      EXPECT_EQ(nodes.contains(layer.mesh.element(e)[static_cast<std::size_t>(k)] + 1), k < 9 || k > 11);
}

TEST(InputDeck, SetsTheBladeBackByTheGapWhenItsFlanksAreInContact) {
  ProfileParameters parameters;
  parameters.flank("left").mismatch = 20e-6;
  const fem::SectorMesh sector = section(parameters);
  const std::map<int, Eigen::Vector3d> glued = nodes_of(inp(sector, kMaterials));
  const std::string deck = inp(sector, kMaterials, {.joint = FlankJoint::contact, .friction = 0.4});
  EXPECT_THAT(deck, HasSubstr("*FRICTION\n0.4,"));
  const std::string rough =
      inp(sector, kMaterials, {.joint = FlankJoint::contact, .contact_stiffness = 2e13, .stick_stiffness = 1e13});
  EXPECT_THAT(rough, HasSubstr("PRESSURE-OVERCLOSURE=LINEAR\n20000\n"));
  EXPECT_THAT(rough, HasSubstr(",10000\n"));
  EXPECT_THAT(deck, Not(HasSubstr("*STATIC")));
  const std::map<int, Eigen::Vector3d> open = nodes_of(deck);
  const fem::Flank& flank = sector.flanks.front();
  const Eigen::VectorXd gap = flank.interpolation * flank.gap;
  EXPECT_NEAR(gap.maxCoeff(), 20e-6, 1e-12);
  for (std::size_t p = 0; p < flank.pairs.size(); ++p) {
    const Eigen::Vector2d shift = open.at(flank.pairs[p][0] + 1).head<2>() - glued.at(flank.pairs[p][0] + 1).head<2>();
    EXPECT_LT((shift + 1e3 * gap[static_cast<Eigen::Index>(p)] * flank.normal).norm(), 1e-9);
    EXPECT_EQ(open.at(flank.pairs[p][1] + 1), glued.at(flank.pairs[p][1] + 1));
  }
}

TEST(InputDeck, RefusesWhatItCannotWrite) {
  fem::SectorMesh sector = section();
  EXPECT_THROW((void)inp(sector, std::vector<fem::Material>(1)), InputError);
  EXPECT_THROW((void)inp(sector, kMaterials, {.nodal_diameters = {24}}), InputError);
  EXPECT_THROW((void)inp(sector, kMaterials, {.nodal_diameters = {}}), InputError);
  EXPECT_THROW((void)inp(sector, kMaterials, {.modes = 0}), InputError);
  EXPECT_THROW((void)inp(sector, kMaterials, {.joint = FlankJoint::contact, .friction = -0.1}), InputError);
  sector.mesh.regions.front().plane_stress = true;
  EXPECT_NO_THROW((void)inp(sector, kMaterials));
  EXPECT_THROW((void)inp(sector, kMaterials, {.nodal_diameters = {1}}), InputError);
}

}  // namespace
}  // namespace dovetail::geometry
