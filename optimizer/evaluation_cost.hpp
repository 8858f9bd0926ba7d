#pragma once

#include <span>

#include "optimizer/problem/load_case.hpp"
#include "optimizer/scene/scene.hpp"

namespace dovetail::optimizer {

/// Sizes of a design's computation that its cost follows from.
struct CandidateSizes {
  bool in_space = false;
  double unknowns = 0;             ///< of the finite elements
  double contact_nodes = 0;        ///< of the first grid; where worn zones end there will be some more
  double jacobian_operations = 0;  ///< of a Jacobian in which all of them take part
};

/// Of a design on the topology of a reference, which is meshed. Throws InputError when neither can be.
[[nodiscard]] CandidateSizes sizes_foreseen(const Scene& reference, const Scene& scene);

/// What an evaluation without bars takes, s of one core: `base + per_unknown u^unknown_power + per_operation sqrt(o)`
/// for u unknowns and o operations of a Jacobian. And bytes of memory: `memory + memory_per_unknown u^memory_power`.
struct CostParams {
  double base, per_unknown, unknown_power, per_operation;
  double memory, memory_per_unknown, memory_power;
};

/// Expected cost.
struct Cost {
  double seconds = 0;  ///< of one evaluation without bars, by one core
  double bytes = 0;    ///< of the process
};
[[nodiscard]] Cost cost_foreseen(const CandidateSizes& sizes);

/// What other computations take, in evaluations without bars.
struct WorkParams {
  double bars = 1;      ///< with them
  double verify = 1;    ///< by history and on a finer mesh
  double describe = 1;  ///< with bars, history and curves
  double finer = 1;     ///< on a mesh with twice the edges
};
[[nodiscard]] WorkParams work_foreseen(bool in_space);

/// What all cases of a design take, in evaluations without cases: those that find their matrices computed take less.
[[nodiscard]] double loads_foreseen(std::span<const LoadCase> cases, Prestress prestress);

}  // namespace dovetail::optimizer
