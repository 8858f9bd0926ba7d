#pragma once

#include "steady/state.hpp"

namespace dovetail::wear {

/// Stands for a threshold that follows from the model.
inline constexpr double kFromModel = -1.0;

/// Wear per cycle that counts as none, m: `given` unless it is negative (kFromModel), else
///
///   4e-6 max_i v_i mu_i p_i 4 mu_i lambda_N,i / k_T,i,
///
/// with the volume v that the law takes for energy (Archard: k_w / mu), the largest normal force over the period
/// lambda_N and pressure p of node i, and its own tangential stiffness k_T: mu lambda_N / k_T is what a node gives way
/// elastically before it slides, there and back twice per cycle. Nodes that a spin-up left at their friction limit
/// slide by less than that in every cycle, which is noise. The rate scales with loads, lengths, moduli and wear
/// coefficients as genuine rates do. For a titanium dovetail of k_w = 1e-13 1/Pa it is about 1e-15 m: 1 um in 1e9
/// cycles.
[[nodiscard]] double no_wear_rate(double given, const dynamics::CondensedModel& model, const steady::State& unworn);

}  // namespace dovetail::wear
