// The stages of an evaluation one after the other, each alone, beside what they cannot do without: processor times,
// medians of repetitions. `compare` runs it on two commits, and under valgrind to count instructions.
//   build/tests/benchmarks/stage_benchmark [--scenes NAME,...] [--stages NAME,...] [--all]
#include <cblas.h>
#include <gnu/libc-version.h>
#include <suitesparse/cholmod.h>
#include <sys/resource.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <exception>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "numerics/process.hpp"
#include "tests/benchmarks/stages/scene_report.hpp"

namespace {

using namespace dovetail::benchmarks;

struct Choice {
  std::vector<std::string> scenes, stages;
  int repetitions = 5;
  bool all = false, no_limits = false, once = false;
  std::string json;
};

/// Of what counts of instructions hang on.
nlohmann::json versions() {
  return {{"compiler", __VERSION__},
          {"openblas", openblas_get_config()},
          {"eigen", std::to_string(EIGEN_WORLD_VERSION) + "." + std::to_string(EIGEN_MAJOR_VERSION) + "." +
                        std::to_string(EIGEN_MINOR_VERSION)},
          {"cholmod", CHOLMOD_MAIN_VERSION * 10000 + CHOLMOD_SUB_VERSION * 100 + CHOLMOD_SUBSUB_VERSION},
          {"libc", gnu_get_libc_version()}};
}

double peak_gib() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / (1 << 20);
}

void describe(CLI::App& app, Choice& choice) {
  std::string scenes = "Of:";
  std::vector<std::string> names;
  for (const BenchmarkScene& scene : benchmark_scenes()) {
    names.emplace_back(scene.name);
    scenes += "\n" + names.back() + ": " + std::string(scene.meaning);
  }
  app.add_option("--scenes", choice.scenes, scenes + "\nDefault: all but the last.")
      ->delimiter(',')
      ->check(CLI::IsMember(names));
  app.add_option("--stages", choice.stages, "Default: all but error_bars. Those before them are run all the same.")
      ->delimiter(',')
      ->check(CLI::IsMember({"feasibility", "mesh", "assembly", "prestress", "reduction", "factorisation", "modes",
                             "trace", "condensation", "preload", "contact_fit", "unworn_resonance", "stress",
                             "asymptote", "worn_resonance", "whole", "error_bars"}));
  app.add_option("--repetitions", choice.repetitions, "Of each stage, at least 1.")->check(CLI::Range(1, 1000));
  app.add_flag("--all", choice.all, "All scenes and stages: minutes.");
  app.add_flag("--no-limits", choice.no_limits, "Stages alone, without what they cannot do without.");
  app.add_flag("--once", choice.once, "Each once, without a table: for tools that count instructions.");
  app.add_option("--json", choice.json, "File for the figures.");
}

void measure_scenes(const Choice& choice) {
  const Selection selection{
      .stages = {choice.stages.begin(), choice.stages.end()}, .error_bars = choice.all, .limits = !choice.no_limits};
  nlohmann::json answer = {
      {"scenes", nlohmann::json::object()}, {"counted", nlohmann::json::array()}, {"versions", versions()}};
  for (const BenchmarkScene& scene : benchmark_scenes()) {
    const bool named = std::ranges::find(choice.scenes, scene.name) != choice.scenes.end();
    if (!(choice.scenes.empty() ? choice.all || !scene.slow : named)) continue;
    Measurement measurement(choice.once ? 1 : choice.repetitions);
    const SceneReport report = measure(scene, selection, measurement);
    if (!choice.once) print(report);
    std::fflush(stdout);
    answer["scenes"][report.scene] = to_json(report);
    for (const std::string& work : measurement.counted()) answer["counted"].push_back({report.scene, work});
  }
  if (!choice.once) std::printf("\npeak memory %.2f GiB\n", peak_gib());
  if (choice.json.empty()) return;
  std::ofstream file(choice.json);
  file << answer.dump(1) << '\n';
  if (!file) throw std::runtime_error(choice.json + ": cannot be written");
}

}  // namespace

int main(int count, char** arguments) {
  dovetail::numerics::prepare_process(arguments);
  Choice choice;
  CLI::App app("Stages of an evaluation beside their limits");
  describe(app, choice);
  CLI11_PARSE(app, count, arguments);
  try {
    measure_scenes(choice);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "stage_benchmark: %s\n", error.what());
    return 3;
  }
  return 0;
}
