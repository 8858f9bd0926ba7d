#include <array>

#include "contact/wear_law.hpp"

namespace dovetail::contact {

static constexpr std::array kArchardParameters{
    WearParameter{.key = "wear_coefficient_per_pa",
                  .unit = "1/Pa",
                  .number = &WearNumbers::coefficient,
                  .standard = 1e-13,
                  .range = {.lower = 0, .upper = 1e-6},
                  .help = "Archard's k_w: wear depth per pressure and slipped distance"}};

constinit const WearLaw kArchard{
    .name = "archard",
    .title = "Archard wear",
    .meaning = "depth by pressure and slipped distance",
    .parameters = kArchardParameters,
    .rate =
        [](const WearNode& node, const Slip& slip) {
          const double slope = node.law.coefficient / node.area;
          return WearRate{.depth = slope * slip.load, .by_load = slope};
        },
    .resting_energy = [](const WearNode&) { return 0.0; },
    .volume_per_energy = [](const WearNode& node,
                            double) { return node.friction > 0 ? node.law.coefficient / node.friction : 0; }};

}  // namespace dovetail::contact
