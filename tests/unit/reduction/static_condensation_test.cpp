#include "reduction/static_condensation.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "reduction/validation.hpp"
#include "tests/unit/reduction/stiffness_error.hpp"
#include "tests/unit/reduction/truss_model.hpp"

namespace dovetail::reduction {
namespace {

class CondensedStatics : public testing::TestWithParam<double> {};
INSTANTIATE_TEST_SUITE_P(StandstillAndSpinSoftened, CondensedStatics, testing::Values(0.0, 20.0));

TEST_P(CondensedStatics, RecoversTheFullSolutionForGivenContactDisplacements) {
  const FullModel full = truss_model({.speed = GetParam()});
  const StaticCondensation condensed = condense_statically(full);
  ASSERT_EQ(condensed.status, Status::converged);
  const ReducedModel& model = condensed.model;
  EXPECT_TRUE(violations(model).empty());
  EXPECT_EQ(model.mass.norm() + model.damping.norm(), 0);
  const Eigen::Index contact = full.contact_size();
  ASSERT_EQ(model.size(), contact);

  Eigen::VectorXd r(contact);
  for (Eigen::Index k = 0; k < contact; ++k) r(k) = 1e-5 * std::cos(1.7 * static_cast<double>(k));
  const Eigen::VectorXd u = condensed.recovery.apply(r, Eigen::MatrixXd());
  EXPECT_EQ(Eigen::VectorXd(u.tail(contact)), r);
  // Internal equilibrium, and the reduced contact forces are those of the full model.
  const Eigen::VectorXd residual = full.static_force - full.stiffness * u;
  const Eigen::VectorXd lambda = model.static_force - model.stiffness * r;
  // eps |K| |u| is about 1e-10 N here.
  EXPECT_LT(residual.head(full.internal_size()).norm(), 1e-10 * full.static_force.norm());
  EXPECT_LT((residual.tail(contact) - lambda).norm(), 1e-10 * lambda.norm());
}

TEST(StaticCondensation, EqualsTheDynamicStiffnessAtZeroFrequency) {
  const FullModel full = truss_model({.speed = 5});
  const Eigen::MatrixXd exact = condensed_stiffness(full, 0);
  EXPECT_LT((condense_statically(full).model.stiffness - exact).norm(), 1e-11 * exact.norm());
}

TEST(StaticCondensation, OutputsAreThoseOfTheFieldBeyondTheLoadAlone) {
  const FullModel full = truss_model({.speed = 5});
  const StaticCondensation condensed = condense_statically(full);
  const Eigen::VectorXd r = Eigen::VectorXd::LinSpaced(full.contact_size(), -1e-5, 2e-5);
  const Eigen::VectorXd moved = condensed.recovery.apply(r, Eigen::MatrixXd()) - condensed.recovery.offset;
  const Eigen::VectorXd expected = full.outputs.transpose() * moved;
  EXPECT_LT((condensed.model.output_vectors * r - expected).norm(), 1e-11 * expected.norm());
}

TEST(StaticCondensation, ScalesTheOffsetWithTheLoad) {
  const FullModel full = truss_model({.speed = 5});
  const StaticCondensation condensed = condense_statically(full);
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(full.contact_size());
  const Eigen::VectorXd half = condensed.recovery.apply(zero, Eigen::MatrixXd(), 0.5);
  EXPECT_EQ(half, Eigen::VectorXd(0.5 * condensed.recovery.offset));
}

TEST(StaticCondensation, ReportsAnIndefiniteGluedStructure) {
  EXPECT_EQ(condense_statically(truss_model({.speed = 1e4})).status, Status::singular);
}

}  // namespace
}  // namespace dovetail::reduction
