#include "contact/wear_law.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>

namespace dovetail::contact {
namespace {

// What every wear law promises; a new one is in wear_laws() and passes.
class WearLawContract : public testing::TestWithParam<const WearLaw*> {
 protected:
  const WearLaw& law_ = *GetParam();
  // Under Coulomb's law energy is mu times the slip load.
  [[nodiscard]] Slip slip(double energy) const { return {.load = energy / node_.friction, .energy = energy}; }

  WearNode node_{.area = 2e-6, .friction = 0.4, .law = {.coefficient = 3e-13, .threshold = 5}};
};

TEST_P(WearLawContract, DoesNotWearWithoutSlipOrCoefficient) {
  EXPECT_EQ(law_.rate(node_, {}).depth, 0);
  node_.law.coefficient = 0;
  EXPECT_EQ(law_.rate(node_, slip(1e-3)).depth, 0);
  EXPECT_EQ(law_.rate(node_, slip(1e-3)).by_load, 0);
  EXPECT_EQ(law_.rate(node_, slip(1e-3)).by_energy, 0);
}

TEST_P(WearLawContract, RestsUpToItsThresholdAndNoFurther) {
  const double rest = law_.resting_energy(node_);
  EXPECT_GE(rest, 0);
  EXPECT_EQ(law_.rate(node_, slip(rest * (1 - 1e-12))).depth, 0);
  EXPECT_GT(law_.rate(node_, slip(rest * (1 + 1e-6) + 1e-12)).depth, 0);
  node_.law.threshold = 0;
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
  for (const double energy : {1e-6, 1e-4, 1e-2}) {  // beyond that of rest
    const WearRate rate = law_.rate(node_, slip(law_.resting_energy(node_) + energy));
    const double volume = node_.area * (rate.by_load / node_.friction + rate.by_energy);
    EXPECT_NEAR(law_.volume_per_energy(node_, energy), volume, 1e-9 * volume);
  }
  node_.friction = 0;
  EXPECT_EQ(law_.volume_per_energy(node_, 1e-4), 0);
}

TEST_P(WearLawContract, IsFoundByItsName) {
  EXPECT_EQ(find_wear_law(law_.name), &law_);
}

TEST_P(WearLawContract, SaysWhatItIs) {
  for (const std::string_view text : {law_.name, law_.title, law_.meaning}) EXPECT_FALSE(text.empty());
  // Its name is written without quotes and its meaning within a list that is separated by semicolons.
  EXPECT_EQ(law_.name.find_first_not_of("abcdefghijklmnopqrstuvwxyz_"), std::string_view::npos);
  EXPECT_EQ(law_.meaning.find(';'), std::string_view::npos);
}

TEST_P(WearLawContract, HasAParameterForEachNumberItUses) {
  ASSERT_NE(law_.parameter(&WearNumbers::coefficient), nullptr);
  for (const WearParameter& parameter : law_.parameters) {
    SCOPED_TRACE(parameter.key);
    EXPECT_EQ(law_.parameter(parameter.number), &parameter);
    EXPECT_TRUE(parameter.range.contains(parameter.standard));
    EXPECT_GE(parameter.range.lower, 0);  // models refuse what is negative
    EXPECT_FALSE(parameter.unit.empty());
    EXPECT_FALSE(parameter.help.empty());
    EXPECT_EQ(standard_wear_numbers().at(std::string(law_.name)).*parameter.number, parameter.standard);
  }
  // A number without a parameter cannot be given: the law must not hang on it.
  WearNode other = node_;
  for (double WearNumbers::*number : {&WearNumbers::coefficient, &WearNumbers::threshold})
    if (!law_.parameter(number)) other.law.*number = 2 * node_.law.*number + 1;
  const double energy = 2 * law_.resting_energy(node_) + 1e-4;
  EXPECT_EQ(law_.resting_energy(other), law_.resting_energy(node_));
  EXPECT_EQ(law_.rate(other, slip(energy)).depth, law_.rate(node_, slip(energy)).depth);
  EXPECT_EQ(law_.volume_per_energy(other, energy), law_.volume_per_energy(node_, energy));
}

TEST_P(WearLawContract, SharesNoKeyWithAnotherLaw) {
  std::set<std::string_view> keys;
  for (const WearLaw* law : wear_laws())
    for (const WearParameter& parameter : law->parameters)
      EXPECT_TRUE(keys.insert(parameter.key).second) << parameter.key;
  for (const WearParameter& parameter : law_.parameters) {
    EXPECT_EQ(law_with_parameter(parameter.key), &law_);
    EXPECT_EQ(find_wear_parameter(parameter.key), &parameter);
  }
}

INSTANTIATE_TEST_SUITE_P(All, WearLawContract, testing::ValuesIn(wear_laws().begin(), wear_laws().end()),
                         [](const auto& law) { return std::string(law.param->name); });

TEST(WearLaw, OfAnotherNameThereIsNone) {
  EXPECT_EQ(find_wear_law("gravity"), nullptr);
  EXPECT_EQ(law_with_parameter("gravity_m_per_s2"), nullptr);
  EXPECT_EQ(find_wear_parameter("gravity_m_per_s2"), nullptr);
}

}  // namespace
}  // namespace dovetail::contact
