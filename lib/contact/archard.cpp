#include "contact/wear_law.hpp"

namespace dovetail::contact {

const WearLaw kArchard{
    .name = "archard",
    .rate =
        [](const WearNode& node, double slip_load) {
          const double slope = node.coefficient / node.area;
          return WearRate{.depth = slope * slip_load, .by_slip_load = slope};
        },
    .resting_slip_load = [](const WearNode&) { return 0.0; },
    .volume_per_energy = [](const WearNode& node) { return node.friction > 0 ? node.coefficient / node.friction : 0; }};

}  // namespace dovetail::contact
