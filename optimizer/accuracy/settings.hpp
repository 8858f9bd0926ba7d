#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "optimizer/scene/scene.hpp"

namespace dovetail::optimizer {

/// What accuracy is bought with.
struct Settings {
  double mesh = 1;    ///< edges of the mesh over those of the scene, along the flanks
  double beside = 1;  ///< and beside them, where they are chosen on their own
  int harmonics = 0, samples = 0, modes = 0;
  double resonance_tolerance = 0;  ///< of the frequency of a resonance, relative
  double history_tolerance = 0;    ///< of a wear history, relative
  bool operator==(const Settings&) const = default;
};

/// Those of a scene.
[[nodiscard]] Settings settings_of(const Scene& scene);

/// The scene with them.
[[nodiscard]] Scene with_settings(Scene scene, const Settings& settings);

/// Keys of a study file that they set, with their values in the file's unit.
[[nodiscard]] std::map<std::string, double> settings_by_key(const Scene& scene, const Settings& settings);

/// Of wear histories, that leaves little of an accuracy asked for.
[[nodiscard]] double history_tolerance(const Scene& scene, const std::set<std::string>& fixed, double accuracy);

/// Whether the mesh beside the flanks may be chosen on its own.
[[nodiscard]] bool chooses_beside(const Scene& scene, const std::set<std::string>& fixed);

/// All combinations that are allowed, where keys in `fixed` stay as they are: any key of the mesh along the flanks
/// keeps all of that, any beside them all of what is there. Histories have the tolerance above.
[[nodiscard]] std::vector<Settings> all_settings(const Scene& scene, const std::set<std::string>& fixed,
                                                 double accuracy);

/// Whether a key is one of those settings.
[[nodiscard]] bool buys_accuracy(const Scene& scene, const std::string& key);

}  // namespace dovetail::optimizer
