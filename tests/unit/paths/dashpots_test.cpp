#include "paths/dashpots.hpp"

#include <gtest/gtest.h>

#include "paths/params.hpp"
#include "paths/steady_state.hpp"
#include "steady/solve.hpp"
#include "steady/tangent.hpp"
#include "tests/verification/steady/rod.hpp"

namespace dovetail::paths {
namespace {

class FadingDashpots : public testing::Test {
 protected:
  FadingDashpots()
      : problem_(joint_, std::make_shared<const dynamics::HarmonicSystem>(
                             dynamics::harmonic_system(*joint_.model, joint_.options.harmonics, kOmega))),
        dashpots_(problem_, problem_.dof_penalty()) {}

  static constexpr double kOmega = 2.5, kStrong = 10;
  const steady::Joint joint_{.model = verification::condensed(verification::rod(5))};
  const steady::Problem problem_;
  const Dashpots dashpots_;
  const steady::Attempt strong_ =
      steady::solve(std::make_shared<const steady::Problem>(problem_.at(dashpots_.system(kStrong))),
                    problem_.closed_start(), steady::Method::newton, joint_.options.max_iterations);
};

TEST_F(FadingDashpots, LeadToTheStateWithoutThem) {
  ASSERT_EQ(strong_.status, Status::converged);
  const branches::Branch followed = dashpots_.follow(kStrong, strong_.point.displacement, WayParams{}.curve);
  ASSERT_EQ(followed.status, Status::converged);
  const steady::State direct = steady_state(joint_, kOmega);
  ASSERT_EQ(direct.status, Status::converged);
  const double size = direct.displacement.norm();
  // Both to a residual of 1e-9, and the strong dashpots leave hardly any of the motion.
  EXPECT_LT((followed.points.back().state.displacement - direct.displacement).norm(), 1e-7 * size);
  EXPECT_GT((strong_.point.displacement - direct.displacement).norm(), 1e-2 * size);
}

TEST_F(FadingDashpots, AreNotLentToTheModel) {
  ASSERT_EQ(strong_.status, Status::converged);
  steady::Point point = strong_.point;
  steady::differentiate(point);
  const auto tangent = std::make_shared<const steady::Tangent>(std::make_shared<const steady::Point>(std::move(point)));
  ASSERT_FALSE(tangent->problem().system().of_model);
  const steady::State direct = steady_state(joint_, kOmega), reused = steady_state(joint_, kOmega, {}, tangent);
  ASSERT_EQ(reused.status, Status::converged);
  EXPECT_LT((reused.displacement - direct.displacement).norm(), 1e-7 * direct.displacement.norm());
}

TEST_F(FadingDashpots, AreLostWithoutJacobians) {
  branches::FollowOptions one = WayParams{}.curve;
  one.max_jacobians = 1;
  EXPECT_NE(dashpots_.follow(kStrong, strong_.point.displacement, one).status, Status::converged);
}

}  // namespace
}  // namespace dovetail::paths
