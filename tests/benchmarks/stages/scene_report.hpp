#pragma once

#include <nlohmann/json_fwd.hpp>
#include <set>
#include <string>
#include <vector>

#include "tests/benchmarks/stages/chain.hpp"

namespace dovetail::benchmarks {

/// What is asked of a scene.
struct Selection {
  std::set<std::string> stages;  ///< empty: all but error bars
  bool error_bars = false;       ///< these, too, where no stages are named
  bool limits = true;            ///< kernels besides

  [[nodiscard]] bool contains(const std::string& stage) const;
};

struct StageReport {
  std::string name;
  std::vector<double> seconds;
  Needs needs;
};

struct KernelReport {
  Kernel kernel;
  std::vector<double> seconds;
};

struct SceneReport {
  std::string scene;
  double unknowns = 0, trace = 0, contact_nodes = 0;
  std::vector<StageReport> stages;
  std::vector<KernelReport> kernels;
};

/// Measures the stages of a scene one after the other. Throws std::runtime_error where one does not come to its end.
[[nodiscard]] SceneReport measure(const BenchmarkScene& scene, const Selection& selection, Measurement& measurement);

/// As a table: processor seconds, those that the kernels of a stage's needs take, the ratio, and what they are.
void print(const SceneReport& report);

[[nodiscard]] nlohmann::json to_json(const SceneReport& report);

}  // namespace dovetail::benchmarks
