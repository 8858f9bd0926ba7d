#include "contact/wear_law.hpp"

#include <array>

namespace dovetail::contact {

std::span<const WearLaw* const> wear_laws() {
  static constexpr std::array kLaws{&kArchard, &kEnergyWear};
  return kLaws;
}

const WearLaw* find_wear_law(std::string_view name) {
  for (const WearLaw* law : wear_laws())
    if (law->name == name) return law;
  return nullptr;
}

}  // namespace dovetail::contact
