#pragma once

#include <cstdint>

namespace dovetail::optimizer {

/// Random numbers that are the same bits on every platform (splitmix64 [Steele, Lea, Flood 2014]); the distributions of
/// `<random>` are not.
class RandomStream {
 public:
  explicit RandomStream(std::uint64_t seed) : state_(seed) {}

  [[nodiscard]] std::uint64_t bits() {
    state_ += 0x9E3779B97F4A7C15ULL;
    std::uint64_t z = state_;
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9ULL;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBULL;
    return z ^ (z >> 31);
  }
  /// Uniform in [0, 1), a multiple of 2^-53.
  [[nodiscard]] double uniform() { return static_cast<double>(bits() >> 11) * 0x1.0p-53; }
  /// Uniform in 0..count-1, count > 0; without bias.
  [[nodiscard]] std::uint64_t below(std::uint64_t count) {
    const std::uint64_t excess = (~count + 1) % count;  // 2^64 mod count
    for (;;)
      if (const std::uint64_t drawn = bits(); drawn >= excess) return drawn % count;
  }

 private:
  std::uint64_t state_;
};

}  // namespace dovetail::optimizer
