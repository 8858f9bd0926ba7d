#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>
#include <string_view>

namespace dovetail::hard_cases {

/// The same numbers on every platform (splitmix64; the distributions of <random> differ between libraries).
class Random {
 public:
  Random(std::string_view name, int index) {
    for (const char c : name) state_ = (state_ ^ static_cast<unsigned char>(c)) * 0x100000001b3ULL;
    state_ += static_cast<std::uint64_t>(index) * 0x9e3779b97f4a7c15ULL;
    for (int i = 0; i < 4; ++i) next();
  }
  /// In [0, 1).
  double unit() { return static_cast<double>(next() >> 11) * 0x1p-53; }
  double between(double low, double high) { return low + (high - low) * unit(); }
  /// Log-uniform, 0 < low <= high.
  double decades(double low, double high) { return low * std::pow(high / low, unit()); }
  int integer(int low, int high) { return low + static_cast<int>(unit() * (high - low + 1)); }
  bool chance(double probability) { return unit() < probability; }
  double normal() {
    const double radius = std::sqrt(-2 * std::log(1 - unit()));
    return radius * std::cos(2 * std::numbers::pi * unit());
  }

 private:
  std::uint64_t next() {
    std::uint64_t z = (state_ += 0x9e3779b97f4a7c15ULL);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
    return z ^ (z >> 31);
  }
  std::uint64_t state_ = 0xcbf29ce484222325ULL;
};

}  // namespace dovetail::hard_cases
