#include "contact/wear_law.hpp"

namespace dovetail::contact {

const WearLaw kEnergyWear{
    .name = "energy",
    .rate =
        [](const WearNode& node, double slip_load) {
          const double excess = node.friction * slip_load / node.area - node.threshold;
          if (!(excess > 0)) return WearRate{};
          return WearRate{.depth = node.coefficient * excess,
                          .by_slip_load = node.coefficient * node.friction / node.area};
        },
    .resting_slip_load =
        [](const WearNode& node) { return node.friction > 0 ? node.threshold * node.area / node.friction : 0; },
    .volume_per_energy = [](const WearNode& node) { return node.friction > 0 ? node.coefficient : 0; }};

}  // namespace dovetail::contact
