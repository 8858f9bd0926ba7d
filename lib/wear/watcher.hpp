#pragma once

#include <functional>

namespace dovetail::wear {

/// How a wear computation is watched and stopped from outside; both members may be empty.
struct Watcher {
  /// Asked before every steady state; true ends the computation with Status::interrupted and what is finished.
  std::function<bool()> stop = {};
  /// Called after every accepted step or pass: number done, worn volume so far m^3, largest rate m/cycle.
  std::function<void(int step, double worn_volume, double largest_rate)> progress = {};

  [[nodiscard]] bool stopped() const { return stop && stop(); }
  void report(int step, double volume, double rate) const {
    if (progress) progress(step, volume, rate);
  }
};

}  // namespace dovetail::wear
