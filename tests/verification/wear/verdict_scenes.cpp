#include "verdict_scenes.hpp"

#include <random>

namespace dovetail::wear::scenes {

namespace {

class Draw {
 public:
  explicit Draw(unsigned seed) : generator_(seed) {}
  /// std::uniform_real_distribution is not the same everywhere; this is.
  double operator()(double low, double high) {
    return low + (high - low) * static_cast<double>(generator_()) / 4294967296.0;
  }

 private:
  std::mt19937 generator_;
};

Punch verdict_punch(unsigned number) {
  Draw between(177u + number);
  Punch data;
  data.nodes = 41;
  data.friction = between(0.3, 0.7);
  data.tangential_load = between(0.2, 0.6) * data.friction * data.normal_load;
  data.offset = between(-0.1, 0.1);
  data.tilt = between(-0.05, 0.05);
  return data;
}

SpacePunch verdict_space_punch(unsigned number, bool sprung) {
  Draw between(277u + number);
  SpacePunch data;
  data.side = 7;
  data.friction = between(0.3, 0.7);
  const double limit = data.friction * data.normal_load;
  data.first_load = between(0.25, 0.55) * limit;
  data.second_load = between(0.0, 0.5) * limit;
  data.offset = between(-0.2, 0.2);
  if (!sprung) return data;
  data.first_load *= 2.0;
  data.tangential_spring = between(0.2, 2.0);
  data.breathing_load = between(0.0, 0.8) * data.normal_load;
  return data;
}

}  // namespace

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
    case Family::punch:
      return "punch";
    case Family::interference:
      return "interference";
    case Family::hopping:
      return "hopping";
    case Family::space:
      return "space";
    case Family::space_sprung:
      return "space_sprung";
  }
  return "unknown";
}

Block verdict_block(Family family, unsigned number) {
  if (family == Family::crowned) return random_block(number);
  Draw between(77u + number);
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
    case Family::interference:
      // The springs give way far less than the block: they press it with about its usual load.
      data.normal_spring = between(0.05, 0.3);
      data.interference = between(0.7, 1.5) * data.normal_load / data.normal_spring;
      data.tangential_spring = between(0.2, 1.0);
      pull = between(0.5, 1.6);
      break;
    case Family::hopping:
      data.normal_spring = between(0.5, 3.0);
      data.tangential_spring = between(0.5, 3.0);
      data.breathing_load = between(1.05, 1.8) * data.normal_load;
      pull = between(0.3, 1.5);
      break;
    default:
      break;
  }
  data.tangential_load = pull * data.friction * data.normal_load;
  if (family == Family::interference) data.normal_load = 0.0;
  return data;
}

reduction::ReducedModel verdict_model(Family family, unsigned number) {
  if (family == Family::punch) return punch(verdict_punch(number));
  if (family == Family::space || family == Family::space_sprung)
    return space_punch(verdict_space_punch(number, family == Family::space_sprung));
  return block(verdict_block(family, number));
}

}  // namespace dovetail::wear::scenes
