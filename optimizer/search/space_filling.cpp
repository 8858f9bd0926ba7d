#include "optimizer/search/space_filling.hpp"

#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>

#include "optimizer/search/params.hpp"
#include "optimizer/search/random_stream.hpp"

namespace dovetail::optimizer {

namespace {

std::vector<std::vector<double>> one_sample(std::size_t count, std::size_t dimension, RandomStream& random) {
  std::vector<std::vector<double>> points(count, std::vector<double>(dimension));
  std::vector<std::size_t> slice(count);
  for (std::size_t axis = 0; axis < dimension; ++axis) {
    std::iota(slice.begin(), slice.end(), std::size_t{0});
    for (std::size_t i = count; i > 1; --i) std::swap(slice[i - 1], slice[random.below(i)]);
    for (std::size_t i = 0; i < count; ++i)
      points[i][axis] = (static_cast<double>(slice[i]) + random.uniform()) / static_cast<double>(count);
  }
  return points;
}

double smallest_distance_squared(const std::vector<std::vector<double>>& points) {
  double smallest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      double sum = 0;
      for (std::size_t k = 0; k < points[i].size(); ++k)
        sum += (points[i][k] - points[j][k]) * (points[i][k] - points[j][k]);
      smallest = std::min(smallest, sum);
    }
  }
  return smallest;
}

}  // namespace

std::vector<std::vector<double>> latin_hypercube(std::size_t count, std::size_t dimension, std::uint64_t seed) {
  RandomStream random(seed);
  std::vector<std::vector<double>> best = one_sample(count, dimension, random);
  double widest = smallest_distance_squared(best);
  for (int sample = 1; sample < kHypercubes; ++sample) {
    std::vector<std::vector<double>> points = one_sample(count, dimension, random);
    const double distance = smallest_distance_squared(points);
    if (distance > widest) {
      widest = distance;
      best = std::move(points);
    }
  }
  return best;
}

}  // namespace dovetail::optimizer
