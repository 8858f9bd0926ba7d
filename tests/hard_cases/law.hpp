#pragma once

#include <array>
#include <vector>

namespace dovetail::hard_cases {

/// Normal component first, then one or two tangential ones (the last is zero with one).
using Vector = std::array<double, 3>;

/// How a node is followed from sample to sample.
struct Law {
  double friction = 0;
  bool second_order = false;     ///< a slip that goes on turns by the exact angle of a slip direction that follows a
                                 ///< straight path, instead of jumping to the closest point
  bool touches_between = false;  ///< contact begins where the normal prediction passes zero between two samples
};

/// What a node remembers, and what the last sample did to it.
struct Memory {
  Vector slip{};       ///< lambda_x = eps X: slip, and in the normal direction the opening (<= 0), N
  double angle = 0;    ///< of the last slip
  bool slid = false;   ///< at the last sample
  bool open = false;   ///< at the last sample
  double stretch = 1;  ///< |trial force| / limit where it slid, else 1
};

/// One period of a contact node, sample by sample.
struct Orbit {
  std::vector<Vector> force;   ///< lambda, N
  std::vector<Memory> memory;  ///< after each sample
  bool periodic = false;
  double uncertainty = 0;  ///< distance to the periodic orbit: rounding, multiplied where slip dies out slowly, N
};

/// Unilateral contact and Coulomb friction followed from sample to sample: at every sample the force is the closest
/// point of the friction cone's section |lambda_T| <= mu lambda_N, lambda_N = max(0, prediction_N), to the trial force
/// prediction_T - eps X_T. Repeated until the slip at the end of a period is that at its start, or as far from it as
/// `resolution`, relative to the largest prediction, permits (0: to rounding).
[[nodiscard]] Orbit periodic_orbit(const std::vector<Vector>& prediction, const Law& law, const Memory& start,
                                   double resolution = 0);

/// No contact force at all.
[[nodiscard]] Orbit free_orbit(const std::vector<Vector>& prediction);

/// How far slip and tangential force of `coarse` may be from those of `fine` at the samples they share [coarse
/// samples], N, by what marching in large steps costs: `fine` follows `law` on all samples of `prediction`, `coarse`
/// steps over a whole number of them at a time, by `law` or a rougher one.
///
/// With F_n the fine march over one step of the coarse one, x and y the slips of coarse and fine:
///   |x_n - y_n| <= |x_n - F_n(x_(n-1))| + |F_n(x_(n-1)) - F_n(y_(n-1))| <= d_n + kappa_n |x_(n-1) - y_(n-1)|.
/// d_n, the error of one step, is found by marching it finely from the coarse state. kappa_n: sticking keeps a
/// difference; of two points outside a circle, the closest points on it are closer by its radius over the smaller
/// distance to its centre; opening, and slipping in the same direction in a plane, forget it. Neither can
/// the slips be further apart than the circle that both lie in is wide.
[[nodiscard]] std::vector<double> march_error(const std::vector<Vector>& prediction, const Law& law,
                                              const Orbit& coarse, const Orbit& fine, bool in_plane);

}  // namespace dovetail::hard_cases
