#pragma once

#include <chrono>

namespace dovetail::optimizer {

/// Seconds since construction or the last lap.
class Stopwatch {
 public:
  [[nodiscard]] double lap() {
    const Clock::time_point now = Clock::now();
    const double seconds = std::chrono::duration<double>(now - last_).count();
    last_ = now;
    return seconds;
  }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point last_ = Clock::now();
};

}  // namespace dovetail::optimizer
