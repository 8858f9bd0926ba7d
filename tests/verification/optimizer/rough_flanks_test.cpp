// Scenes with rough flanks: the mode that is followed, its limits, and what is said of asperities that are too soft.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <string>
#include <vector>

#include "optimizer/candidate/candidate_result.hpp"
#include "tests/verification/optimizer/coarse_scene.hpp"

namespace dovetail::optimizer {
namespace {

// Flanks so rough that their asperities carry the blade: the glued mode has the springs in it, and the search for the
// resonance starts there. Frequencies by Eigen, of all coordinates but the stuck ones; those without mass are at
// infinity.
TEST(RoughFlanks, VeryRoughFlanksVibrateInTheSameMode) {
  Scene scene = coarse_scene();
  scene.loading.tip_force *= 1e-3;
  double before = 1e300;
  for (const double stiffness : {1e13, 1e12, 1e11, 1e10, 1e9}) {
    scene.contact.normal_stiffness = scene.contact.tangential_stiffness = stiffness;
    const CandidateResult candidate = through_stages(scene, ModelBuilder(scene).build(scene), {});
    ASSERT_TRUE(candidate.evaluation.converged()) << candidate.evaluation.status;
    const reduction::ReducedModel& model = candidate.model.model;
    std::vector<bool> stuck(static_cast<std::size_t>(model.size()), false);
    for (const int dof : model.contact.normal) stuck[static_cast<std::size_t>(dof)] = true;
    for (const int dof : model.contact.tangential.reshaped()) stuck[static_cast<std::size_t>(dof)] = true;
    std::vector<Eigen::Index> free;
    for (Eigen::Index i = 0; i < model.size(); ++i)
      if (!stuck[static_cast<std::size_t>(i)]) free.push_back(i);
    const Eigen::MatrixXd mass = model.mass(free, free), rigidity = model.stiffness(free, free);
    const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> inverse(mass, rigidity, Eigen::EigenvaluesOnly);
    const double glued = 1 / std::sqrt(inverse.eigenvalues().maxCoeff());
    EXPECT_NEAR(candidate.model.glued_frequencies(0) / glued, 1, 1e-7) << stiffness;
    // Stuck by the pull of the blade, damped by a thousandth.
    EXPECT_NEAR(candidate.unworn->omega / glued, 1, 2e-3) << stiffness;
    EXPECT_LT(glued, before);
    before = glued;
  }
}

// Springs of the range's upper end leave what they give way, in proportion; in one direction alone, too.
TEST(RoughFlanks, GluedFrequenciesAreRigidInTheLimit) {
  Scene scene = coarse_scene();
  const double rigid = ModelBuilder(scene).build(scene).glued_frequencies(0);
  for (const bool normal : {true, false}) {
    const auto softer = [&](double stiffness) {
      scene.contact.normal_stiffness = normal ? stiffness : 0;
      scene.contact.tangential_stiffness = normal ? 0 : stiffness;
      return 1 - ModelBuilder(scene).build(scene).glued_frequencies(0) / rigid;
    };
    const double stiffest = softer(1e20);
    EXPECT_LT(std::abs(stiffest), 2e-9);
    EXPECT_NEAR(softer(1e17) / softer(1e18), 10, 0.3);
  }
}

// Where the pull moves the blade further than its flanks are long nothing that is computed stands as it is.
TEST(RoughFlanks, AsperitiesThatAreTooSoftAreSaid) {
  Scene scene = coarse_scene();
  const auto messages = [&](double stiffness) {
    scene.contact.normal_stiffness = stiffness;
    std::string all;
    for (const std::string& message :
         through_stages(scene, ModelBuilder(scene).build(scene), {.until = Stage::unworn}).evaluation.messages)
      all += message + "\n";
    return all;
  };
  EXPECT_EQ(messages(0).find("asperities"), std::string::npos);
  EXPECT_EQ(messages(1e13).find("asperities"), std::string::npos);
  EXPECT_NE(messages(1e10).find("The asperities of the flanks let the blade move by"), std::string::npos);
}

}  // namespace
}  // namespace dovetail::optimizer
