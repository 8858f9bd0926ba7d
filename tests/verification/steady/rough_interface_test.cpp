// Rough flanks: stiffness per area in series with the contact.
#include "reduction/rough_interface.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "paths/steady_state.hpp"
#include "steady/preload.hpp"
#include "tests/verification/steady/rod.hpp"

namespace dovetail::verification {
namespace {

using Model = std::shared_ptr<const dynamics::CondensedModel>;

Model condensed(const reduction::ReducedModel& model) {
  return std::make_shared<const dynamics::CondensedModel>(model);
}

// m = k = 1, pressed on by 1 through a normal spring of 2, rubbing with mu = 0.4 under a force of 0.5.
reduction::ReducedModel rubbing(bool behind_a_spring, double spring) {
  const Eigen::Index n = behind_a_spring ? 3 : 2;
  reduction::ReducedModel model = empty_model(n, 1, 1);
  model.stiffness(0, 0) = 2;
  model.stiffness(1, 1) = 1;
  model.mass(1, 1) = 1;
  model.damping(1, 1) = 0.02;
  if (behind_a_spring) {
    model.stiffness(1, 1) += spring;
    model.stiffness(2, 2) = spring;
    model.stiffness(1, 2) = model.stiffness(2, 1) = -spring;
  }
  model.static_force(0) = 1;
  model.cosine_force(0, 1) = 0.5;
  model.output_vectors = Eigen::MatrixXd::Zero(1, n);
  model.output_vectors(0, 1) = 1;
  model.output_names = {"mass"};
  model.contact.normal(0) = 0;
  model.contact.tangential(0, 0) = behind_a_spring ? 2 : 1;
  model.contact.friction(0) = 0.4;
  model.contact.area(0) = 0.25;
  return model;
}

TEST(RoughInterface, IsASpringBetweenTheStructureAndItsContact) {
  constexpr double kSpring = 1.5;
  reduction::ReducedModel rough = rubbing(false, 0);
  reduction::add_interface({.tangential = kSpring / rough.contact.area(0)}, rough);
  const Model with_interface = condensed(rough), with_spring = condensed(rubbing(true, kSpring));
  int slipping = 0;
  for (const double omega : {0.7, 1.1, 1.6}) {
    const steady::State one = paths::steady_state({with_interface}, omega);
    const steady::State other = paths::steady_state({with_spring}, omega);
    ASSERT_EQ(one.status, Status::converged);
    slipping += one.nodes.front().slips;
    EXPECT_NEAR(one.amplitudes(0), other.amplitudes(0), 1e-8 * other.amplitudes(0)) << omega;
    EXPECT_NEAR(one.friction_energy, other.friction_energy, 1e-8 * other.friction_energy) << omega;
  }
  EXPECT_GE(slipping, 1);
}

TEST(RoughInterface, TakesItsShareOfTheClosing) {
  // A spring of 2 carries what the contact does not: lambda = (P - k g) / (1 + k / k_n).
  reduction::ReducedModel model = rubbing(false, 0);
  model.contact.gap(0) = 0.1;
  const double rigid = steady::quasi_static(condensed(model)).force(0);
  EXPECT_NEAR(rigid, 1 - 2 * 0.1, 1e-12);
  reduction::add_interface({.normal = 3 / model.contact.area(0)}, model);
  const steady::Preload preload = steady::quasi_static(condensed(model));
  ASSERT_EQ(preload.status, Status::converged);
  EXPECT_NEAR(preload.force(0), (1 - 2 * 0.1) / (1 + 2.0 / 3), 1e-12);
  // The structure goes further than its contact, by the compression of the spring.
  EXPECT_NEAR(preload.full_displacement(0), 0.1 + preload.force(0) / 3, 1e-12);
}

TEST(RoughInterface, IsRigidWhereItIsStiff) {
  const steady::State rigid = paths::steady_state({condensed(rod(5))}, 2.0);
  ASSERT_EQ(rigid.status, Status::converged);
  const auto difference = [&](double stiffness) {
    reduction::ReducedModel model = rod(5);
    reduction::add_interface({.normal = stiffness, .tangential = stiffness}, model);
    const steady::State rough = paths::steady_state({condensed(model)}, 2.0);
    EXPECT_EQ(rough.status, Status::converged);
    return std::abs(rough.amplitudes(0) / rigid.amplitudes(0) - 1);
  };
  const double soft = difference(1e4), stiff = difference(1e5);
  EXPECT_NEAR(soft / stiff, 10, 1);
  EXPECT_LT(stiff, 1e-2);
}

TEST(RoughInterface, LeavesARigidDirectionAsItIs) {
  reduction::ReducedModel model = rod(3);
  const reduction::ReducedModel before = model;
  reduction::add_interface({}, model);
  EXPECT_EQ(model.size(), before.size());
  reduction::add_interface({.normal = 1}, model);
  EXPECT_EQ(model.contact.tangential, before.contact.tangential);
  EXPECT_EQ(model.size(), before.size() + before.contact.count());
}

}  // namespace
}  // namespace dovetail::verification
