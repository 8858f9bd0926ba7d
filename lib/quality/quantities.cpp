#include "quality/quantities.hpp"

#include <cmath>

namespace dovetail::quality {

Quantities quantities(const dynamics::CondensedModel& model, const steady::State& state) {
  Quantities result{.amplitudes = state.amplitudes, .friction_energy = state.friction_energy};
  if (state.wear_rate.size() == 0) return result;
  result.largest_wear_rate = state.wear_rate.maxCoeff();
  result.wear_volume_rate = model.contact().area.dot(state.wear_rate);
  return result;
}

Quantities constant_quantities(Eigen::Index outputs, double value) {
  return {.amplitudes = Eigen::VectorXd::Constant(outputs, value),
          .friction_energy = value,
          .largest_wear_rate = value,
          .wear_volume_rate = value};
}

Quantities distance(const Quantities& a, const Quantities& b) {
  return combine(a, b, [](double x, double y) { return std::abs(x - y); });
}

}  // namespace dovetail::quality
