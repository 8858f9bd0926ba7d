#include "contact/wear_law.hpp"

namespace dovetail::contact {

const WearLaw kArchard{
    .name = "archard",
    .rate =
        [](const WearNode& node, const Slip& slip) {
          const double slope = node.coefficient / node.area;
          return WearRate{.depth = slope * slip.load, .by_load = slope};
        },
    .resting_energy = [](const WearNode&) { return 0.0; },
    .volume_per_energy = [](const WearNode& node) { return node.friction > 0 ? node.coefficient / node.friction : 0; }};

}  // namespace dovetail::contact
