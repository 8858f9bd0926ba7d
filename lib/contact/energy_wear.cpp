#include "contact/wear_law.hpp"

namespace dovetail::contact {

const WearLaw kEnergyWear{
    .name = "energy",
    .rate =
        [](const WearNode& node, const Slip& slip) {
          const double excess = slip.energy / node.area - node.threshold;
          if (!(excess > 0)) return WearRate{};
          return WearRate{.depth = node.coefficient * excess, .by_energy = node.coefficient / node.area};
        },
    .resting_energy = [](const WearNode& node) { return node.threshold * node.area; },
    .volume_per_energy = [](const WearNode& node) { return node.friction > 0 ? node.coefficient : 0; }};

}  // namespace dovetail::contact
