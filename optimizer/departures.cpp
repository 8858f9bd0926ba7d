#include "optimizer/departures.hpp"

#include <vector>

namespace dovetail::optimizer {

std::span<const LoadCase> usual_departures() {
  const auto times = [](const char* name, const char* key, double factor) {
    return LoadCase{.name = name, .changes = {{.key = key, .value = 0, .times = factor}}};
  };
  const auto plus = [](const char* name, const char* key, double more) {
    return LoadCase{.name = name, .changes = {{.key = key, .value = more, .times = 1}}};
  };
  static const std::vector<LoadCase> usual{
      times("friction -40 %", "contact.friction", 0.6),
      times("friction +40 %", "contact.friction", 1.4),
      times("half the force", "loading.tip_force_n", 0.5),
      times("twice the force", "loading.tip_force_n", 2),
      times("speed -10 %", "scene.speed_rpm", 0.9),
      times("speed +10 %", "scene.speed_rpm", 1.1),
      plus("mismatch -5 um", "geometry.flank_mismatch_um", -5),
      plus("mismatch +5 um", "geometry.flank_mismatch_um", 5),
  };
  return usual;
}

}  // namespace dovetail::optimizer
