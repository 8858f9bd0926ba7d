#include "contact/wear_law.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

namespace dovetail::contact {
namespace {

// What every wear law promises; a new one is in wear_laws() and passes.
class WearLawContract : public testing::TestWithParam<const WearLaw*> {
 protected:
  const WearLaw& law_ = *GetParam();
  // Under Coulomb's law energy is mu times the slip load.
  [[nodiscard]] Slip slip(double energy) const { return {.load = energy / node_.friction, .energy = energy}; }

  WearNode node_{.area = 2e-6, .friction = 0.4, .coefficient = 3e-13, .threshold = 5};
};

TEST_P(WearLawContract, DoesNotWearWithoutSlipOrCoefficient) {
  EXPECT_EQ(law_.rate(node_, {}).depth, 0);
  node_.coefficient = 0;
  EXPECT_EQ(law_.rate(node_, slip(1e-3)).depth, 0);
  EXPECT_EQ(law_.rate(node_, slip(1e-3)).by_load, 0);
  EXPECT_EQ(law_.rate(node_, slip(1e-3)).by_energy, 0);
}

TEST_P(WearLawContract, RestsUpToItsThresholdAndNoFurther) {
  const double rest = law_.resting_energy(node_);
  EXPECT_GE(rest, 0);
  EXPECT_EQ(law_.rate(node_, slip(rest * (1 - 1e-12))).depth, 0);
  EXPECT_GT(law_.rate(node_, slip(rest * (1 + 1e-6) + 1e-12)).depth, 0);
  node_.threshold = 0;
  EXPECT_EQ(law_.resting_energy(node_), 0);
}

TEST_P(WearLawContract, HasTheDerivativesOfItsRateWhichNeverFalls) {
  const double rest = law_.resting_energy(node_);
  for (const double energy : {1.5 * rest + 1e-6, 3 * rest + 1e-5, 10 * rest + 1e-4}) {
    const double step = 1e-4 * (energy - rest);
    const WearRate rate = law_.rate(node_, slip(energy));
    const auto difference = [&](double load_step, double energy_step) {
      const auto at = [&](double side) {
        const Slip middle = slip(energy);
        return law_.rate(node_, {middle.load + side * load_step, middle.energy + side * energy_step}).depth;
      };
      return (at(1) - at(-1)) / (2 * step);
    };
    EXPECT_NEAR(rate.by_load, difference(step, 0), 1e-9 * rate.by_load);
    EXPECT_NEAR(rate.by_energy, difference(0, step), 1e-9 * rate.by_energy);
    EXPECT_GE(std::min(rate.by_load, rate.by_energy), 0);
    EXPECT_GT(rate.by_load + rate.by_energy, 0);
  }
}

TEST_P(WearLawContract, TakesVolumeForEnergy) {
  const WearRate rate = law_.rate(node_, slip(2 * law_.resting_energy(node_) + 1e-4));
  EXPECT_NEAR(law_.volume_per_energy(node_), node_.area * (rate.by_load / node_.friction + rate.by_energy),
              1e-12 * node_.coefficient / node_.friction);
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
