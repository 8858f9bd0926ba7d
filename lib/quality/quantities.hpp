#pragma once

#include <Eigen/Core>

#include "steady/state.hpp"

namespace dovetail::quality {

/// The results of one steady state that carry error bars and sensitivities. The same layout holds values, bars
/// (absolute, in the unit of the value; infinite: unknown) and logarithmic slopes.
struct Quantities {
  Eigen::VectorXd amplitudes;    ///< of the outputs [n_out], half peak-to-peak
  double friction_energy = 0;    ///< J per cycle
  double largest_wear_rate = 0;  ///< depth per cycle of the node that wears fastest, m
  double wear_volume_rate = 0;   ///< sum of area times wear rate, m^3 per cycle
};

/// Of a state of this model.
[[nodiscard]] Quantities quantities(const dynamics::CondensedModel& model, const steady::State& state);

/// All entries equal, for `outputs` outputs.
[[nodiscard]] Quantities constant_quantities(Eigen::Index outputs, double value);

/// |a - b| entry by entry.
[[nodiscard]] Quantities distance(const Quantities& a, const Quantities& b);

/// `combine` entry by entry of two, or of one.
template <class Function>
[[nodiscard]] Quantities combine(const Quantities& a, const Quantities& b, const Function& function) {
  return {.amplitudes = a.amplitudes.binaryExpr(b.amplitudes, function),
          .friction_energy = function(a.friction_energy, b.friction_energy),
          .largest_wear_rate = function(a.largest_wear_rate, b.largest_wear_rate),
          .wear_volume_rate = function(a.wear_volume_rate, b.wear_volume_rate)};
}
template <class Function>
[[nodiscard]] Quantities transform(const Quantities& a, const Function& function) {
  return {.amplitudes = a.amplitudes.unaryExpr(function),
          .friction_energy = function(a.friction_energy),
          .largest_wear_rate = function(a.largest_wear_rate),
          .wear_volume_rate = function(a.wear_volume_rate)};
}

}  // namespace dovetail::quality
