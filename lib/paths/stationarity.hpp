#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "core/options.hpp"
#include "paths/params.hpp"

namespace dovetail::paths {

/// The slopes of the amplitude met on the way to its maximum, relative to it, by their place on the branch (omega, or
/// the distance from the start along one direction), and where to look next: a secant for the slope, kept inside the
/// bracket of the maximum. The slope jumps where samples change their contact state. A secant across a jump is as steep
/// as its points are close, and the step it proposes as short: alone it does not tell that the maximum is near.
class Stationarity {
 public:
  struct Mark {
    double place = 0, omega = 0, amplitude = 0, slope = 0;
  };

  /// `curvature` < 0: the slope's derivative at the maximum of a linear system, the first guess; `trust`: the longest
  /// step without a bracket.
  Stationarity(double curvature, double trust) : linear_(curvature), curvature_(curvature), trust_(trust) {}

  void add(const Mark& now) {
    if (now_ && now.place != now_->place) {
      const double secant = (now.slope - now_->slope) / (now.place - now_->place);
      curvature_ = secant < 0 ? secant : linear_;
    }
    probe_ = now_ && now.slope * now_->slope > 0 ? kParams.farther * probe_ : 0;
    now_ = now;
    if (now.slope > 0 && (!rising_ || now.place > rising_->place)) rising_ = now;
    if (now.slope <= 0 && (!falling_ || now.place < falling_->place)) falling_ = now;
    // Another peak, or a fold, can cross the marks: keep the newest one.
    if (rising_ && falling_ && rising_->place >= falling_->place) (now.slope > 0 ? falling_ : rising_).reset();
    widths_.push_back(width());
  }

  [[nodiscard]] bool bracketed() const { return rising_ && falling_; }
  [[nodiscard]] bool is_end(double place) const {
    return (rising_ && rising_->place == place) || (falling_ && falling_->place == place);
  }
  /// Between the ends of the bracket, in units of place; infinite without one.
  [[nodiscard]] double width() const { return bracketed() ? falling_->place - rising_->place : kInfinity; }
  /// Width of the bracket in omega; infinite without one, or when the curve jumps to another branch within it.
  [[nodiscard]] double bracket() const {
    if (!bracketed() || std::abs(rising_->amplitude - falling_->amplitude) > kParams.continuous * now_->amplitude)
      return kInfinity;
    return std::abs(falling_->omega - rising_->omega);
  }

  /// Whether the maximum is known to `tolerated`, a distance of places: its bracket is so narrow and no jump to another
  /// branch, or the step to it is small by the secant and by a linear system's curvature alike.
  [[nodiscard]] bool settled(double tolerated) const {
    if (width() <= tolerated) return std::isfinite(bracket());
    return std::abs(secant_step()) <= kParams.part * tolerated && std::abs(now_->slope / linear_) <= tolerated;
  }

  /// How far the maximum may be from the last place, when it is settled.
  [[nodiscard]] double error() const {
    return std::min(width(), std::max(std::abs(secant_step()), std::abs(now_->slope / linear_)));
  }

  /// Where to go next, as a step from the last place; not so short that it could not settle the maximum by a bracket.
  [[nodiscard]] double step(double tolerated) {
    double wanted = secant_step();
    if (std::abs(wanted) < kParams.part * tolerated && !settled(tolerated)) {
      probe_ = std::max(probe_, kParams.probe * tolerated);
      wanted = std::copysign(std::min(probe_, trust_), wanted);
    } else {
      probe_ = 0;
    }
    if (!bracketed()) return wanted;
    const auto inside = [&](double place) { return place > rising_->place && place < falling_->place; };
    // Points that do not halve the bracket: the slope jumps there, or one end stays. A step somewhat too long brings
    // the other end near, a bisection what nothing else does.
    const std::size_t n = widths_.size();
    const bool stalling = n > 2 && widths_[n - 1] > 0.5 * widths_[n - 3];
    const bool one_sided = std::abs(wanted) < kParams.one_sided * widths_.back() && n % 2 == 0;
    if (stalling && one_sided && inside(now_->place + kParams.overshoot * wanted)) return kParams.overshoot * wanted;
    if (stalling || !inside(now_->place + wanted)) return (rising_->place + falling_->place) / 2 - now_->place;
    return wanted;
  }

 private:
  [[nodiscard]] double secant_step() const { return std::clamp(-now_->slope / curvature_, -trust_, trust_); }

  static constexpr StationarityParams kParams = {};
  double linear_, curvature_;  // < 0
  double trust_;
  double probe_ = 0;  // the last step that was made longer than the secant's
  std::optional<Mark> now_, rising_, falling_;
  std::vector<double> widths_;
};

}  // namespace dovetail::paths
