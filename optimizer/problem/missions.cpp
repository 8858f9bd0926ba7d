#include "optimizer/problem/missions.hpp"

#include <algorithm>
#include <map>
#include <string>
#include <tuple>

#include "optimizer/problem/uncertainty.hpp"

namespace dovetail::optimizer {

namespace {

/// Whether all cases of a mission change the same of the geometry, if anything: uncertain numbers of one sample.
bool same_shape(std::span<const LoadCase> cases, const MissionCases& mission) {
  const auto of_geometry = [](const LoadCase& load) {
    std::vector<std::tuple<std::string, double, double>> changes;
    for (const auto& [key, value, times] : load.changes)
      if (key.starts_with("geometry.")) changes.emplace_back(key, value, times);
    std::ranges::sort(changes);
    return changes;
  };
  return std::ranges::all_of(
      mission.cases, [&](std::size_t i) { return of_geometry(cases[i]) == of_geometry(cases[mission.cases.front()]); });
}

}  // namespace

std::vector<MissionCases> missions_of(std::span<const LoadCase> cases, bool named) {
  if (cases.empty()) return named ? std::vector{MissionCases{.cases = {0}}} : std::vector<MissionCases>();
  std::map<std::string, std::size_t> of_sample;  // "" where nothing is uncertain
  std::vector<MissionCases> missions;
  bool several = false;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const std::string& of = cases[i].sample_of;
    several = several || of != kSampleOfStudy;
    const std::string sample = of.empty() ? "" : cases[i].name.substr(of.size());
    const auto [at, first] = of_sample.try_emplace(sample, missions.size());
    if (first) missions.push_back({.cases = {}, .named = named});
    missions[at->second].cases.push_back(i);
  }
  const bool one_shape =
      std::ranges::all_of(missions, [&](const MissionCases& mission) { return same_shape(cases, mission); });
  return one_shape && (named || several) ? missions : std::vector<MissionCases>();
}

}  // namespace dovetail::optimizer
