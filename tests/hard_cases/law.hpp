#pragma once

#include <array>
#include <vector>

namespace dovetail::hard_cases {

/// Normal component first, then one or two tangential ones (the last is zero with one).
using Vector = std::array<double, 3>;

/// One period of a contact node, sample by sample.
struct Orbit {
  std::vector<Vector> force;       ///< lambda, N
  std::vector<Vector> slip_force;  ///< eps X: slip, and in the normal direction the opening (<= 0), N
  bool periodic = false;
  double uncertainty = 0;  ///< distance to the periodic orbit: rounding, multiplied where slip dies out slowly, N
};

/// Unilateral contact and Coulomb friction followed from sample to sample: at every sample the force is the closest
/// point of the friction cone's section |lambda_T| <= mu lambda_N, lambda_N = max(0, prediction_N), to the trial force
/// prediction_T - eps X_T. Repeated until the slip at the end of a period is that at its start. `second_order`: a slip
/// that goes on turns by the exact angle of a slip direction that follows a straight path, instead of jumping to
/// the closest point, and contact begins where the normal prediction passes zero between two samples.
[[nodiscard]] Orbit periodic_orbit(const std::vector<Vector>& prediction, double friction, bool second_order,
                                   const Vector& slip_force);

/// No contact force at all.
[[nodiscard]] Orbit free_orbit(const std::vector<Vector>& prediction);

}  // namespace dovetail::hard_cases
