#pragma once

#include <string>
#include <vector>

#include "geometry/profile/profile.hpp"

namespace dovetail::geometry {

/// A closed chain under a name: one layer of a drawing.
struct Layer {
  std::string name;
  Chain chain;
};

/// What is drawn of a design: BLADE, finished with the form of its flanks (flank_form.hpp), and DISK.
[[nodiscard]] std::vector<Layer> section_layers(const ProfileParameters& parameters);

}  // namespace dovetail::geometry
