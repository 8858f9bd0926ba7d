#include "optimizer/evaluation_cost.hpp"

#include <gtest/gtest.h>

#include "steady/work.hpp"
#include "studies/program/engine/engine.hpp"
#include "studies/program/study_file/study_template.hpp"

namespace dovetail::optimizer {
namespace {

/// An evaluation without bars and history as it was measured: processor seconds and peak memory.
struct Measured {
  const char* study;
  bool in_space;
  double unknowns;
  int contact_nodes, harmonics;
  double seconds, megabytes;
};
constexpr Measured kMeasured[] = {
    {"quickstart", false, 16354, 34, 5, 0.78, 142},
    {"quickstart, 12 edges per flank, 6 mm elements", false, 12102, 24, 5, 0.50, 126},
    {"quickstart, 6 edges, 12 mm", false, 5386, 12, 5, 0.27, 100},
    {"quickstart, 48 edges", false, 20238, 46, 5, 1.04, 160},
    {"quickstart, 9 harmonics", false, 16354, 34, 9, 0.93, 142},
    {"quickstart, 16 edges, 3 harmonics", false, 14774, 28, 3, 0.60, 136},
    {"quickstart, 48 edges, 1 mm, 7 harmonics", false, 44910, 46, 7, 2.09, 290},
    {"quickstart, 96 edges", false, 28498, 66, 5, 1.61, 213},
    {"bladed_disk_2009", true, 74069, 96, 3, 13.58, 1181},
    {"skewed_slot", true, 74069, 96, 3, 10.18, 1231},
    {"skewed_slot, 6 layers, 6 edges", true, 48997, 72, 3, 5.60, 753},
};

TEST(EvaluationCost, IsForeseenWithinAFactorOfTwo) {
  constexpr int kSamples = 128;
  constexpr double kMegabyte = 1024.0 * 1024.0;
  for (const Measured& of : kMeasured) {
    const Cost cost = cost_foreseen({.in_space = of.in_space,
                                     .unknowns = of.unknowns,
                                     .contact_nodes = static_cast<double>(of.contact_nodes),
                                     .jacobian_operations = steady::jacobian_operations(
                                         of.contact_nodes, of.in_space ? 3 : 2, of.harmonics, kSamples)});
    EXPECT_GT(cost.seconds, of.seconds / 2) << of.study;
    EXPECT_LT(cost.seconds, of.seconds * 2) << of.study;
    EXPECT_GT(cost.bytes, of.megabytes * kMegabyte / 2) << of.study;
    EXPECT_LT(cost.bytes, of.megabytes * kMegabyte * 2) << of.study;
  }
}

// Two speeds, two frictions, two forces: cases that find their matrices computed take a third of those that do not.
TEST(EvaluationCost, KnowsWhatCasesShare) {
  std::vector<LoadCase> cases;
  for (const double speed : {9000, 10000})
    for (const double friction : {0.4, 0.5})
      for (const double force : {1, 2})
        cases.push_back({.name = "case",
                         .changes = {{.key = "scene.speed_rpm", .value = speed},
                                     {.key = "contact.friction", .value = friction},
                                     {.key = "loading.tip_force_n", .value = force}}});
  EXPECT_EQ(loads_foreseen({}, Prestress::own), 1);
  EXPECT_NEAR(loads_foreseen(cases, Prestress::cases), 3.8, 0.4);
  EXPECT_NEAR(loads_foreseen(cases, Prestress::own), 5.4, 0.4);
  // Of two speeds with five fits of the flanks each, shared ones took 0.82 of their own.
  std::vector<LoadCase> fits;
  for (const double speed : {9000, 10000})
    for (const double mismatch : {-2, -1, 0, 1, 2})
      fits.push_back({.name = "case",
                      .changes = {{.key = "scene.speed_rpm", .value = speed},
                                  {.key = "geometry.flank_mismatch_um", .value = mismatch}}});
  EXPECT_NEAR(loads_foreseen(fits, Prestress::shared) / loads_foreseen(fits, Prestress::own), 0.82, 0.05);
  EXPECT_EQ(loads_foreseen(fits, Prestress::cases), loads_foreseen(fits, Prestress::own));  // each has its own gap
}

TEST(EvaluationCost, KnowsTheSizesOfADesign) {
  const studies::Study study = studies::read_study(studies::parse_document(studies::study_template("s"), "s.toml"));
  const CandidateSizes sizes = sizes_foreseen(studies::reference_scene(study), study.scene);
  EXPECT_NEAR(sizes.unknowns, 16354, 0.02 * 16354);  // as an evaluation of it has
  EXPECT_NEAR(sizes.contact_nodes, 34, 8);           // which lays some at the ends of worn zones
  EXPECT_FALSE(sizes.in_space);
}

}  // namespace
}  // namespace dovetail::optimizer
