#include "tests/hard_cases/law.hpp"

#include <algorithm>
#include <cmath>

namespace dovetail::hard_cases {
namespace {

class Follower {
 public:
  Follower(double friction, bool second_order, const Vector& slip_force)
      : friction_(friction), second_order_(second_order), slip_(slip_force) {}

  // Touches down where the prediction, a straight line from the sample before, starts to press.
  void touch(const Vector& before, const Vector& prediction) {
    if (!second_order_ || !open_ || before[0] > 0 || prediction[0] <= 0) return;
    const double open_share = -before[0] / (prediction[0] - before[0]);
    for (std::size_t r = 1; r < 3; ++r) slip_[r] = before[r] + open_share * (prediction[r] - before[r]);
  }

  Vector advance(const Vector& prediction) {
    const double normal = std::max(0.0, prediction[0]);
    const double limit = friction_ * normal;
    const double trial_y = prediction[1] - slip_[1], trial_z = prediction[2] - slip_[2];
    const double size = std::hypot(trial_y, trial_z);
    Vector force{normal, trial_y, trial_z};
    const bool slides = normal > 0 && (size > limit || friction_ == 0);
    if (normal <= 0) {
      force = {0, 0, 0};
    } else if (slides) {
      double angle = size > 0 ? std::atan2(trial_z, trial_y) : 0;
      const double turn = std::remainder(angle - angle_, 8 * std::atan(1.0));
      // On a straight path at constant limit b, tan(phi / 2) = |pre| sin(turn) / (b + |pre| cos(turn)).
      if (second_order_ && slid_ && std::cos(turn) > 0)
        angle = angle_ + 2 * std::atan2(size * std::sin(turn), limit + size * std::cos(turn));
      force[1] = limit * std::cos(angle);
      force[2] = limit * std::sin(angle);
      angle_ = angle;
    }
    slid_ = slides;
    open_ = normal <= 0;
    for (std::size_t r = 0; r < 3; ++r)
      if (r == 0 || normal <= 0 || slides) slip_[r] = prediction[r] - force[r];
    return force;
  }
  [[nodiscard]] const Vector& slip() const { return slip_; }

 private:
  double friction_;
  bool second_order_;
  Vector slip_;
  double angle_ = 0;
  bool slid_ = false, open_ = false;
};

}  // namespace

Orbit periodic_orbit(const std::vector<Vector>& prediction, double friction, bool second_order,
                     const Vector& slip_force) {
  constexpr int kMaxPeriods = 20000;
  constexpr double kRounding = 1e-16, kResolved = 1e-12;
  double largest = 0;
  for (const Vector& p : prediction) largest = std::max({largest, std::abs(p[0]), std::abs(p[1]), std::abs(p[2])});
  Follower follower(friction, second_order, slip_force);
  Orbit orbit;
  orbit.force.resize(prediction.size());
  orbit.slip_force.resize(prediction.size());
  double previous = 0, ratio = 0;
  for (int period = 0; period < kMaxPeriods && !orbit.periodic; ++period) {
    const Vector before = follower.slip();
    for (std::size_t n = 0; n < prediction.size(); ++n) {
      follower.touch(prediction[(n + prediction.size() - 1) % prediction.size()], prediction[n]);
      orbit.force[n] = follower.advance(prediction[n]);
      orbit.slip_force[n] = follower.slip();
    }
    const Vector& after = follower.slip();
    const double change = std::hypot(after[1] - before[1], after[2] - before[2]);
    if (change > kResolved * largest && previous > 0) ratio = std::min(change / previous, 1 - 1e-6);
    orbit.periodic = change <= kRounding * largest || (change <= kResolved * largest && change >= previous);
    orbit.uncertainty = (change + kRounding * largest) / (1 - ratio);
    previous = change;
  }
  return orbit;
}

Orbit free_orbit(const std::vector<Vector>& prediction) {
  return {.force = std::vector<Vector>(prediction.size(), Vector{0, 0, 0}), .slip_force = prediction, .periodic = true};
}

}  // namespace dovetail::hard_cases
