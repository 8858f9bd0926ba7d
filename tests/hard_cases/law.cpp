#include "tests/hard_cases/law.hpp"

#include <algorithm>
#include <cmath>

namespace dovetail::hard_cases {
namespace {

// Slip, in more digits than the forces it brings: where it dies out by 1e-4 per period, roundings of a double would add
// up to 1e-9 of the prediction.
using Slip = std::array<long double, 3>;

class Follower {
 public:
  Follower(const Law& law, const Memory& memory)
      : law_(law), memory_(memory), slip_{memory.slip[0], memory.slip[1], memory.slip[2]} {}

  Vector advance(const Vector& before, const Vector& prediction) {
    touch(before, prediction);
    const double normal = std::max(0.0, prediction[0]);
    const long double limit = static_cast<long double>(law_.friction) * normal;
    const long double trial_y = prediction[1] - slip_[1], trial_z = prediction[2] - slip_[2];
    const long double size = std::hypot(trial_y, trial_z);
    Slip force{normal, trial_y, trial_z};
    const bool slides = normal > 0 && (size > limit || law_.friction == 0);
    if (normal <= 0) {
      force = {0, 0, 0};
    } else if (slides) {
      long double angle = size > 0 ? std::atan2(trial_z, trial_y) : 0;
      const long double turn = std::remainder(angle - angle_, 8 * std::atan(1.0L));
      // On a straight path at constant limit b, tan(phi / 2) = |pre| sin(turn) / (b + |pre| cos(turn)).
      if (law_.second_order && memory_.slid && std::cos(turn) > 0)
        angle = angle_ + 2 * std::atan2(size * std::sin(turn), limit + size * std::cos(turn));
      force[1] = limit * std::cos(angle);
      force[2] = limit * std::sin(angle);
      angle_ = angle;
    }
    memory_.slid = slides;
    memory_.open = normal <= 0;
    memory_.stretch = slides ? static_cast<double>(std::max(1.0L, size / std::max(limit, 1e-300L))) : 1;
    for (std::size_t r = 0; r < 3; ++r)
      if (r == 0 || normal <= 0 || slides) slip_[r] = prediction[r] - force[r];
    return rounded(force);
  }
  [[nodiscard]] Memory memory() const {
    Memory memory = memory_;
    memory.slip = rounded(slip_);
    memory.angle = static_cast<double>(angle_);
    return memory;
  }
  [[nodiscard]] const Slip& slip() const { return slip_; }

 private:
  static Vector rounded(const Slip& v) {
    return {static_cast<double>(v[0]), static_cast<double>(v[1]), static_cast<double>(v[2])};
  }

  // Touches down where the prediction, a straight line from the sample before, starts to press.
  void touch(const Vector& before, const Vector& prediction) {
    if (!law_.touches_between || !memory_.open || before[0] > 0 || prediction[0] <= 0) return;
    const long double open_share = -before[0] / (static_cast<long double>(prediction[0]) - before[0]);
    for (std::size_t r = 1; r < 3; ++r)
      slip_[r] = before[r] + open_share * (static_cast<long double>(prediction[r]) - before[r]);
  }

  Law law_;
  Memory memory_;
  Slip slip_;
  long double angle_ = memory_.angle;
};

template <class V>
double distance(const V& a, const V& b) {
  return static_cast<double>(std::hypot(a[1] - b[1], a[2] - b[2]));
}

// What is left of a difference between two slips after one sample that led to these states.
double kept(const Memory& a, const Memory& b, bool in_plane) {
  if (a.open && b.open) return 0;
  if (!a.slid || !b.slid) return 1;
  if (in_plane) return std::cos(a.angle - b.angle) > 0 ? 0 : 1;
  return 1 / std::min(a.stretch, b.stretch);
}

}  // namespace

Orbit periodic_orbit(const std::vector<Vector>& prediction, const Law& law, const Memory& start, double resolution) {
  constexpr int kMaxPeriods = 1000000;
  constexpr double kRounding = 1e-19, kResolved = 1e-15;
  double largest = 0;
  for (const Vector& p : prediction) largest = std::max({largest, std::abs(p[0]), std::abs(p[1]), std::abs(p[2])});
  Follower follower(law, start);
  Orbit orbit;
  orbit.force.resize(prediction.size());
  orbit.memory.resize(prediction.size());
  double previous = 0, ratio = 0;
  for (int period = 0; period < kMaxPeriods && !orbit.periodic; ++period) {
    const Slip before = follower.slip();
    for (std::size_t n = 0; n < prediction.size(); ++n) {
      orbit.force[n] = follower.advance(prediction[(n + prediction.size() - 1) % prediction.size()], prediction[n]);
      orbit.memory[n] = follower.memory();
    }
    const double change = distance(follower.slip(), before);
    if (change > kResolved * largest && previous > 0) ratio = std::min(change / previous, 1 - 1e-6);
    orbit.periodic = change <= kRounding * largest || (change <= kResolved * largest && change >= previous);
    orbit.uncertainty = (change + kRounding * largest) / (1 - ratio);
    orbit.periodic = orbit.periodic || (period > 0 && orbit.uncertainty <= resolution * largest);
    previous = change;
  }
  return orbit;
}

Orbit free_orbit(const std::vector<Vector>& prediction) {
  Orbit orbit{.force = std::vector<Vector>(prediction.size(), Vector{0, 0, 0}), .memory = {}, .periodic = true};
  for (const Vector& p : prediction) orbit.memory.push_back({.slip = p, .open = true});
  return orbit;
}

std::vector<double> march_error(const std::vector<Vector>& prediction, const Law& law, const Orbit& coarse,
                                const Orbit& fine, bool in_plane) {
  const std::size_t steps = coarse.force.size(), ratio = prediction.size() / steps, all = prediction.size();
  std::vector<double> defect(steps), factor(steps, 1), widest(steps);
  for (std::size_t n = 0; n < steps; ++n) {
    // Samples of both are counted from 0: the step to coarse sample n ends at fine sample n ratio.
    Follower follower(law, coarse.memory[(n + steps - 1) % steps]);
    for (std::size_t k = 1; k <= ratio; ++k) {
      const std::size_t at = (n * ratio + all - ratio + k) % all;
      follower.advance(prediction[(at + all - 1) % all], prediction[at]);
      factor[n] *= kept(follower.memory(), fine.memory[at], in_plane);
    }
    defect[n] = distance(coarse.memory[n].slip, follower.memory().slip);
    widest[n] = 2 * law.friction * std::max(0.0, prediction[n * ratio][0]);
  }
  // From anywhere, once around to the periodic bound, and once more to write it down.
  std::vector<double> error(steps);
  double now = 0, around = 1;
  for (std::size_t n = 0; n < steps; ++n) {
    now = std::min(widest[n], defect[n] + factor[n] * now);
    around *= factor[n];
  }
  // Where neither moves for good, the fine march started on the coarse orbit; alternating closest points of convex sets
  // stay within twice the distance to what these have in common.
  now = around < 1 ? now / (1 - around) : 2 * now;
  for (std::size_t n = 0; n < steps; ++n) error[n] = now = std::min(widest[n], defect[n] + factor[n] * now);
  return error;
}

}  // namespace dovetail::hard_cases
