#include <array>

#include "contact/contact_law.hpp"

namespace dovetail::contact {

const ContactLaw kCoulomb{.name = "coulomb", .limit = [](const NodeLaw& node, double normal) {
                            return FrictionLimit{.force = node.friction * normal, .by_normal = node.friction};
                          }};

std::span<const ContactLaw* const> contact_laws() {
  static constexpr std::array kLaws{&kCoulomb};
  return kLaws;
}

}  // namespace dovetail::contact
