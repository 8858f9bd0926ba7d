#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace dovetail::optimizer {

/// `count` points of the unit cube: each of `count` equal slices of every axis holds one point, at a random place in
/// the slice; of 20 such samples the one whose two nearest points are farthest apart [McKay 1979; Johnson 1990].
/// Deterministic on every platform. Cost: O(20 count^2 dimension).
[[nodiscard]] std::vector<std::vector<double>> latin_hypercube(std::size_t count, std::size_t dimension,
                                                               std::uint64_t seed);

}  // namespace dovetail::optimizer
