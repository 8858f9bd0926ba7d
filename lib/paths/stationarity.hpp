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
    double off = 0;  ///< how far from the branch it was found, in units of place
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
    // A slope found further from the branch than the bracket is wide may be that beyond a jump.
    const double within = width();
    for (std::optional<Mark>* end : {&rising_, &falling_})
      if (*end && (*end)->off > within) end->reset();
    brackets_.push_back({.width = width(), .drop = bracketed() ? rising_->slope - falling_->slope : 0});
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
    // Where secants do not help the slope jumps, as at the crossing of the tangents at the ends of the bracket: a step
    // a little beyond that brings the other end near. Where it does not, a bisection does.
    const std::size_t n = brackets_.size();
    const bool halved = n > 1 && brackets_[n - 1].width <= 0.5 * brackets_[n - 2].width;
    if (n > 2) jumps_ = jumps_ || jumps_between(brackets_[n - 3], brackets_[n - 1]);
    if (!jumps_ && inside(now_->place + wanted)) return wanted;
    const double shortest = 0.5 * kParams.probe * tolerated, middle = (rising_->place + falling_->place) / 2;
    crossed_ = jumps_ && (halved || !crossed_) && width() > 2 * shortest;
    if (!crossed_) return middle - now_->place;
    const double way = crossing() - now_->place;
    const double beyond = way + std::copysign(std::max(kParams.beyond * std::abs(way), shortest), way);
    return std::clamp(now_->place + beyond, rising_->place + shortest, falling_->place - shortest) - now_->place;
  }

 private:
  struct Bracket {
    double width, drop;  ///< places and slopes, one end against the other
  };
  /// Whether two steps have not halved the bracket, or the slope has not fallen with it as it does in a smooth maximum.
  static bool jumps_between(const Bracket& before, const Bracket& now) {
    if (!std::isfinite(before.width)) return false;
    const double shrunk = now.width / before.width;
    return shrunk > 0.5 || now.drop > 2 * shrunk * before.drop;
  }
  /// Of the tangents of ln A at the ends of the bracket.
  [[nodiscard]] double crossing() const {
    const double rise = std::log(falling_->amplitude / rising_->amplitude);
    return rising_->place + (rise - falling_->slope * width()) / (rising_->slope - falling_->slope);
  }
  [[nodiscard]] double secant_step() const { return std::clamp(-now_->slope / curvature_, -trust_, trust_); }

  static constexpr StationarityParams kParams = {};
  double linear_, curvature_;  // < 0
  double trust_;
  double probe_ = 0;                      // the last step that was made longer than the secant's
  bool jumps_ = false, crossed_ = false;  // the slope jumps in the bracket; the last step went beyond the crossing
  std::optional<Mark> now_, rising_, falling_;
  std::vector<Bracket> brackets_;
};

}  // namespace dovetail::paths
