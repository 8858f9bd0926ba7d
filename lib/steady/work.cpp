#include "steady/work.hpp"

#include "steady/params.hpp"

namespace dovetail::steady {

double factorisation_operations(Eigen::Index unknowns) {
  const auto n = static_cast<double>(unknowns);
  return 2.0 / 3.0 * n * n * n;
}

double condensation_operations(Eigen::Index open, Eigen::Index dofs, int harmonics) {
  const auto o = static_cast<double>(open), kept = static_cast<double>(dofs - open);
  return (harmonics + 1) * 8 * o * (o * o / 3 + o * kept + kept * kept);
}

double shared_condensation_operations(Eigen::Index open, Eigen::Index kept, Eigen::Index within, int harmonics) {
  const auto o = static_cast<double>(open), k = static_cast<double>(kept), m = static_cast<double>(within);
  return 2 * o * (o * o / 3 + (o + k) * (k + m) + m * m) + (harmonics + 1) * 30 * m * m * m;
}

double product_operations(double entries) {
  return WorkParams{}.product * entries;
}

double march_operations(int samples, int periods) {
  return WorkParams{}.march_step * samples * periods;
}

double derivative_operations(int samples, int periods, Eigen::Index coefficients) {
  return WorkParams{}.march_coefficient * samples * periods * static_cast<double>(coefficients);
}

double jacobian_operations(Eigen::Index nodes, Eigen::Index directions, int harmonics, int samples) {
  const Eigen::Index coefficients = directions * (2 * harmonics + 1);
  return static_cast<double>(nodes) * (march_operations(samples, 1) + derivative_operations(samples, 1, coefficients)) +
         factorisation_operations(nodes * coefficients);
}

}  // namespace dovetail::steady
