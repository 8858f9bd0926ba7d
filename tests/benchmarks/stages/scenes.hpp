#pragma once

#include <span>
#include <string_view>

#include "optimizer/scene/scene.hpp"

namespace dovetail::benchmarks {

/// What stages are measured on: a design, and the one that a search evaluated before it.
struct BenchmarkScene {
  std::string_view name, meaning;
  optimizer::Scene (*design)();
  void (*make_previous)(optimizer::Scene& design);  ///< changes the design into the one before
  bool slow;                                        ///< measured with --all only
};

[[nodiscard]] std::span<const BenchmarkScene> benchmark_scenes();

/// Null when there is none of this name.
[[nodiscard]] const BenchmarkScene* find_scene(std::string_view name);

}  // namespace dovetail::benchmarks
