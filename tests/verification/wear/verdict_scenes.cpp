#include "verdict_scenes.hpp"

#include <random>

namespace dovetail::wear::scenes {

std::string_view to_string(Family family) {
  switch (family) {
    case Family::crowned:
      return "crowned";
    case Family::coupled:
      return "coupled";
    case Family::breathing:
      return "breathing";
    case Family::sliding:
      return "sliding";
    case Family::sprung:
      return "sprung";
    case Family::pressed:
      return "pressed";
  }
  return "unknown";
}

Block verdict_block(Family family, unsigned number) {
  if (family == Family::crowned) return random_block(number);
  std::mt19937 generator(77u + number);
  const auto between = [&generator](double low, double high) {
    return low + (high - low) * static_cast<double>(generator()) / 4294967296.0;
  };
  Block data;
  data.columns = 16;
  data.height = between(0.4, 0.65);
  data.friction = between(0.3, 0.7);
  data.eccentricity = between(-0.03, 0.03);
  data.crown = between(1.2, 2.6) * 1e-3 * data.height;
  data.coupling = 0.0;
  double pull = between(0.4, 0.58);  // tangential load over mu P
  switch (family) {
    case Family::coupled:
      data.coupling = between(0.2, 1.0);
      break;
    case Family::breathing:
      data.breathing_load = between(0.1, 0.6) * 1e-3;
      pull = between(0.25, 0.5);
      break;
    case Family::sliding:
      pull = between(1.05, 2.5);
      data.tangential_spring = between(0.2, 3.0);
      break;
    case Family::sprung:
      pull = between(0.6, 1.0);
      data.tangential_spring = between(0.1, 1.0);
      break;
    case Family::pressed:
      pull = between(0.02, 0.08);
      data.crown = 0.0;
      break;
    case Family::crowned:
      break;
  }
  data.tangential_load = pull * data.friction * data.normal_load;
  return data;
}

}  // namespace dovetail::wear::scenes
