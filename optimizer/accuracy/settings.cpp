#include "optimizer/accuracy/settings.hpp"

#include <algorithm>
#include <array>
#include <span>
#include <string_view>
#include <utility>

#include "optimizer/accuracy/params.hpp"
#include "optimizer/bars/other_meshes.hpp"
#include "optimizer/scene/scene_kind.hpp"
#include "quality/truncation.hpp"

namespace dovetail::optimizer {

namespace {

constexpr SettingLadders kLadders;

/// Those of [solver] that buy accuracy.
constexpr std::array<std::string_view, 5> kSolverKeys{"solver.harmonics", "solver.samples", "solver.modes",
                                                      "solver.resonance_tolerance", "solver.history_tolerance"};

/// Of the mesh beside the flanks.
std::vector<std::string_view> keys_beside(const Scene& scene) {
  std::vector<std::string_view> keys(scene.kind->beside.begin(), scene.kind->beside.end());
  keys.insert(keys.end(), scene.kind->lengths.begin(), scene.kind->lengths.end());
  return keys;
}

std::vector<std::string_view> keys_along(const Scene& scene) {
  std::vector<std::string_view> keys(scene.kind->counts.begin(), scene.kind->counts.end());
  std::erase_if(keys, [&](std::string_view key) { return std::ranges::count(scene.kind->beside, key) > 0; });
  return keys;
}

std::vector<std::string_view> mesh_keys(const Scene& scene) {
  std::vector<std::string_view> keys = keys_along(scene);
  const std::vector<std::string_view> beside = keys_beside(scene);
  keys.insert(keys.end(), beside.begin(), beside.end());
  return keys;
}

bool any_given(const std::vector<std::string_view>& keys, const std::set<std::string>& fixed) {
  return std::ranges::any_of(keys, [&](std::string_view key) { return fixed.contains(std::string(key)); });
}

/// The rungs of a ladder and the value there is, rising; that value alone where it is fixed.
template <class T>
std::vector<T> rungs(std::span<const T> ladder, T own, bool fixed) {
  if (fixed) return {own};
  std::vector<T> result(ladder.begin(), ladder.end());
  if (std::ranges::find(result, own) == result.end()) result.push_back(own);
  std::ranges::sort(result);
  return result;
}

}  // namespace

Settings settings_of(const Scene& scene) {
  return {.mesh = 1,
          .beside = 1,
          .harmonics = scene.solver.harmonics,
          .samples = scene.solver.samples,
          .modes = scene.solver.modes,
          .resonance_tolerance = scene.solver.resonance_tolerance,
          .history_tolerance = scene.solver.history_tolerance};
}

Scene with_settings(Scene scene, const Settings& settings) {
  if (settings.mesh != 1 || settings.beside != 1)
    scene = resized(std::move(scene), 1 / settings.mesh, 1 / settings.beside);
  scene.solver.harmonics = settings.harmonics;
  scene.solver.samples = settings.samples;
  scene.solver.modes = settings.modes;
  scene.solver.resonance_tolerance = settings.resonance_tolerance;
  scene.solver.history_tolerance = settings.history_tolerance;
  return scene;
}

std::map<std::string, double> settings_by_key(const Scene& scene, const Settings& settings) {
  const Scene there = with_settings(scene, settings);
  std::vector<std::string_view> keys = mesh_keys(scene);
  keys.insert(keys.end(), kSolverKeys.begin(), kSolverKeys.end());
  std::map<std::string, double> values;
  for (const std::string_view key : keys) values[std::string(key)] = parameter(there, key);
  return values;
}

double history_tolerance(const Scene& scene, const std::set<std::string>& fixed, double accuracy) {
  if (fixed.contains("solver.history_tolerance")) return scene.solver.history_tolerance;
  return std::min(kLadders.history * accuracy, kLadders.loosest_history);
}

bool chooses_beside(const Scene& scene, const std::set<std::string>& fixed) {
  return !scene.kind->lengths.empty() && !any_given(keys_beside(scene), fixed);
}

std::vector<Settings> all_settings(const Scene& scene, const std::set<std::string>& fixed, double accuracy) {
  const auto given = [&](std::string_view key) { return fixed.contains(std::string(key)); };
  const bool mesh_given = any_given(keys_along(scene), fixed), beside_given = !chooses_beside(scene, fixed);
  std::vector<double> tolerances = rungs<double>(kLadders.resonance_tolerance, scene.solver.resonance_tolerance,
                                                 given("solver.resonance_tolerance"));
  std::erase_if(tolerances, [&](double tolerance) {
    return tolerance > std::max(scene.solver.resonance_tolerance, kLadders.of_half_width * scene.loading.damping_ratio);
  });
  const double history = history_tolerance(scene, fixed, accuracy);
  std::vector<Settings> result;
  std::vector<std::pair<double, double>> meshes;
  for (const double mesh : rungs<double>(kLadders.mesh, 1, mesh_given))
    for (const double beside : rungs<double>(kLadders.beside, 1, beside_given)) meshes.emplace_back(mesh, beside);
  for (const auto& [mesh, beside] : meshes)
    for (const int harmonics : rungs<int>(kLadders.harmonics, scene.solver.harmonics, given("solver.harmonics")))
      for (const int samples : rungs<int>(kLadders.samples, scene.solver.samples, given("solver.samples"))) {
        // Aliases are kept out, but where both numbers are the user's.
        const bool both_given = given("solver.harmonics") && given("solver.samples");
        if (!both_given && quality::samples_for(harmonics, samples) != samples) continue;
        if (!given("solver.samples") && samples < kLadders.samples_per_coefficient * (2 * harmonics + 1)) continue;
        for (const int modes : rungs<int>(kLadders.modes, scene.solver.modes, given("solver.modes")))
          if (modes >= scene.loading.mode || given("solver.modes"))
            for (const double tolerance : tolerances)
              result.push_back({.mesh = mesh,
                                .beside = beside,
                                .harmonics = harmonics,
                                .samples = samples,
                                .modes = modes,
                                .resonance_tolerance = tolerance,
                                .history_tolerance = history});
      }
  // Samples that are too few for any harmonics on the ladder: there is nothing to choose.
  if (result.empty()) result.push_back(settings_of(scene));
  return result;
}

bool buys_accuracy(const Scene& scene, const std::string& key) {
  return std::ranges::count(mesh_keys(scene), key) > 0 || std::ranges::count(kSolverKeys, key) > 0;
}

}  // namespace dovetail::optimizer
