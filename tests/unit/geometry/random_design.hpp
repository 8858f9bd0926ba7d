#pragma once

#include <random>

#include "geometry/profile/parameters.hpp"

namespace dovetail::geometry {

/// A design with every dimension moved by up to `spread` and the two flanks slightly different; the shank stays wide
/// enough for the blend of its shoulder.
inline ProfileParameters random_design(std::mt19937& generator, double spread = 0.15) {
  std::uniform_real_distribution<double> factor(1 - spread, 1 + spread);
  ProfileParameters p;
  for (const Field<ProfileParameters>& field : option_table<ProfileParameters>())
    if (const auto* member = std::get_if<double ProfileParameters::*>(&field.member)) p.*(*member) *= factor(generator);
  p.shank_width = 1.2 * p.neck_width;
  p.sectors = std::uniform_int_distribution<int>(30, 60)(generator);
  for (FlankParameters& flank : p.flanks) {
    flank.angle *= factor(generator);
    flank.length *= 1 + (factor(generator) - 1) / 3;
  }
  return p;
}

}  // namespace dovetail::geometry
