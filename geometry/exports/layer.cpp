#include "geometry/exports/layer.hpp"

#include "geometry/profile/flank_form.hpp"

namespace dovetail::geometry {

std::vector<Layer> section_layers(const ProfileParameters& parameters) {
  return {{.name = "BLADE", .chain = finished_blade(parameters)},
          {.name = "DISK", .chain = build_profile(parameters).disk}};
}

}  // namespace dovetail::geometry
