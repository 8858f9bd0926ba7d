#include "contact/wear_law.hpp"

#include <algorithm>
#include <array>

namespace dovetail::contact {

std::span<const WearLaw* const> wear_laws() {
  static constexpr std::array kLaws{&kArchard, &kEnergyWear};
  return kLaws;
}

const WearParameter* WearLaw::parameter(double WearNumbers::*number) const {
  const auto found = std::ranges::find(parameters, number, &WearParameter::number);
  return found == parameters.end() ? nullptr : &*found;
}

const WearParameter* WearLaw::parameter(std::string_view key) const {
  const auto found = std::ranges::find(parameters, key, &WearParameter::key);
  return found == parameters.end() ? nullptr : &*found;
}

const WearLaw* find_wear_law(std::string_view name) {
  for (const WearLaw* law : wear_laws())
    if (law->name == name) return law;
  return nullptr;
}

const WearLaw* law_with_parameter(std::string_view key) {
  for (const WearLaw* law : wear_laws())
    if (law->parameter(key)) return law;
  return nullptr;
}

const WearParameter* find_wear_parameter(std::string_view key) {
  const WearLaw* law = law_with_parameter(key);
  return law ? law->parameter(key) : nullptr;
}

std::map<std::string, WearNumbers> standard_wear_numbers() {
  std::map<std::string, WearNumbers> numbers;
  for (const WearLaw* law : wear_laws())
    for (const WearParameter& parameter : law->parameters)
      numbers[std::string(law->name)].*parameter.number = parameter.standard;
  return numbers;
}

}  // namespace dovetail::contact
