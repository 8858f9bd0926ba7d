#include <array>

#include "contact/wear_law.hpp"

namespace dovetail::contact {

static constexpr std::array kEnergyWearParameters{
    WearParameter{.key = "energy_wear_coefficient_m3_per_j",
                  .unit = "m^3/J",
                  .number = &WearNumbers::coefficient,
                  .standard = 2e-13,
                  .range = {.lower = 0, .upper = 1e-6},
                  .help = "under the law energy: worn volume per energy dissipated beyond the threshold"},
    WearParameter{.key = "energy_threshold_j_per_m2",
                  .unit = "J/m^2",
                  .number = &WearNumbers::threshold,
                  .standard = 0,
                  .range = kNonNegative,
                  .help = "under the law energy: what a cycle may dissipate per area before anything wears"}};

constinit const WearLaw kEnergyWear{
    .name = "energy",
    .title = "wear by dissipated energy",
    .meaning = "volume by dissipated energy",
    .parameters = kEnergyWearParameters,
    .rate =
        [](const WearNode& node, const Slip& slip) {
          const double excess = slip.energy / node.area - node.law.threshold;
          if (!(excess > 0)) return WearRate{};
          return WearRate{.depth = node.law.coefficient * excess, .by_energy = node.law.coefficient / node.area};
        },
    .resting_energy = [](const WearNode& node) { return node.law.threshold * node.area; },
    .volume_per_energy = [](const WearNode& node, double) { return node.friction > 0 ? node.law.coefficient : 0; }};

}  // namespace dovetail::contact
