#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <vector>

namespace dovetail::optimizer {

/// Finds what was stored for exactly this vector: equal bit by bit, except that -0.0 is 0.0. The first entry wins.
class ExactCache {
 public:
  [[nodiscard]] std::optional<std::size_t> find(std::span<const double> x) const {
    const auto found = entries_.find(key(x));
    return found == entries_.end() ? std::nullopt : std::optional(found->second);
  }
  void insert(std::span<const double> x, std::size_t index) { entries_.emplace(key(x), index); }
  [[nodiscard]] std::size_t size() const { return entries_.size(); }

 private:
  static std::vector<std::uint64_t> key(std::span<const double> x) {
    std::vector<std::uint64_t> bits;
    bits.reserve(x.size());
    for (const double value : x) bits.push_back(std::bit_cast<std::uint64_t>(value + 0.0));
    return bits;
  }
  std::map<std::vector<std::uint64_t>, std::size_t> entries_;
};

}  // namespace dovetail::optimizer
