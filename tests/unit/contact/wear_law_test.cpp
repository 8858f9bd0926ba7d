#include "contact/wear_law.hpp"

#include <gtest/gtest.h>

#include <string>

namespace dovetail::contact {
namespace {

// What every wear law promises; a new one is in wear_laws() and passes.
class WearLawContract : public testing::TestWithParam<const WearLaw*> {
 protected:
  const WearLaw& law_ = *GetParam();
  WearNode node_{.area = 2e-6, .friction = 0.4, .coefficient = 3e-13, .threshold = 5};
};

TEST_P(WearLawContract, DoesNotWearWithoutSlipOrCoefficient) {
  EXPECT_EQ(law_.rate(node_, 0).depth, 0);
  node_.coefficient = 0;
  EXPECT_EQ(law_.rate(node_, 1e-3).depth, 0);
  EXPECT_EQ(law_.rate(node_, 1e-3).by_slip_load, 0);
}

TEST_P(WearLawContract, RestsUpToItsThresholdAndNoFurther) {
  const double rest = law_.resting_slip_load(node_);
  EXPECT_GE(rest, 0);
  EXPECT_EQ(law_.rate(node_, rest * (1 - 1e-12)).depth, 0);
  EXPECT_GT(law_.rate(node_, rest * (1 + 1e-6) + 1e-12).depth, 0);
  node_.threshold = 0;
  EXPECT_EQ(law_.resting_slip_load(node_), 0);
}

TEST_P(WearLawContract, HasTheDerivativeOfItsRateWhichNeverFalls) {
  const double rest = law_.resting_slip_load(node_);
  for (const double load : {1.5 * rest + 1e-6, 3 * rest + 1e-5, 10 * rest + 1e-4}) {
    const double step = 1e-4 * (load - rest);
    const double difference = (law_.rate(node_, load + step).depth - law_.rate(node_, load - step).depth) / (2 * step);
    const WearRate rate = law_.rate(node_, load);
    EXPECT_NEAR(rate.by_slip_load, difference, 1e-9 * difference);
    EXPECT_GE(rate.by_slip_load, 0);
  }
}

TEST_P(WearLawContract, TakesVolumeForEnergy) {
  // Energy is mu times the slip load.
  const double load = 2 * law_.resting_slip_load(node_) + 1e-4;
  EXPECT_NEAR(law_.volume_per_energy(node_) * node_.friction, node_.area * law_.rate(node_, load).by_slip_load,
              1e-12 * node_.coefficient);
  node_.friction = 0;
  EXPECT_EQ(law_.volume_per_energy(node_), 0);
}

TEST_P(WearLawContract, IsFoundByItsName) {
  EXPECT_EQ(find_wear_law(law_.name), &law_);
}

INSTANTIATE_TEST_SUITE_P(All, WearLawContract, testing::ValuesIn(wear_laws().begin(), wear_laws().end()),
                         [](const auto& law) { return std::string(law.param->name); });

TEST(WearLaw, OfAnotherNameThereIsNone) {
  EXPECT_EQ(find_wear_law("gravity"), nullptr);
}

}  // namespace
}  // namespace dovetail::contact
