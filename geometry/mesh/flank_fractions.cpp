#include "geometry/mesh/flank_fractions.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/mesh/contact_grid.hpp"
#include "geometry/mesh/params.hpp"
#include "geometry/profile/flank_form.hpp"

namespace dovetail::geometry {
namespace {

constexpr FractionParams kFraction = {};

/// Where small edges are wanted, fractions of the length; the other end has its mirror image.
struct Zone {
  double from, to, core;
};

/// Around the beginning of a rounding.
Zone rounding_zone(const FlankParameters& flank, double length) {
  const double w = rounded_length(flank.edge_radius) / length;
  return {.from = kFraction.zone_from * w, .to = kFraction.zone_to * w, .core = kFraction.core * w};
}

std::vector<Zone> zones(const ProfileParameters& reference, double grading) {
  std::vector<Zone> found;
  const double length = reference.mean(&FlankParameters::length);
  for (const FlankParameters& flank : reference.flanks)
    if (flank.edge_radius > 0) found.push_back(rounding_zone(flank, length));
  if (found.empty()) found.push_back({.from = 0, .to = 0, .core = 0.5 / (grading - 1)});
  return found;
}

/// [kFraction.samples + 1] integral of 1/h from 0 to i/(2 kFraction.samples), no h above `largest`.
std::vector<double> integral(const std::vector<Zone>& zones, double largest) {
  std::vector<double> sum{0};
  for (int i = 0; i < kFraction.samples; ++i) {
    const double s = 0.5 * (i + 0.5) / kFraction.samples;
    double h = largest;
    for (const Zone& z : zones) h = std::min(h, z.core + std::max({0.0, z.from - s, s - z.to}));
    sum.push_back(sum.back() + 0.5 / kFraction.samples / h);
  }
  return sum;
}

/// The same with the largest h there may be. Edges are 2 sum h times as long as equal ones.
std::vector<double> bounded_integral(const std::vector<Zone>& zones) {
  double high = std::numeric_limits<double>::infinity();
  for (const Zone& z : zones) high = std::min(high, z.core + std::max(0.0, 0.5 - z.to));  // in the middle
  std::vector<double> sum = integral(zones, high);
  if (2 * sum.back() * high <= kFraction.longest) return sum;
  double low = 0;
  for (int k = 0; k < kFraction.halvings; ++k) {
    const double middle = (low + high) / 2;
    sum = integral(zones, middle);
    (2 * sum.back() * middle > kFraction.longest ? high : low) = middle;
  }
  return sum;
}

}  // namespace

std::vector<double> flank_fractions(const ProfileParameters& reference, const MeshSizes& sizes) {
  const int parts = sizes.flank_elements;
  const bool rounded =
      std::ranges::any_of(reference.flanks, [](const FlankParameters& f) { return f.edge_radius > 0; });
  if (!rounded && sizes.flank_grading == 1) return equal_fractions(parts);
  std::vector<Zone> wanted = zones(reference, sizes.flank_grading);
  const auto integrated = [&] {
    return rounded ? bounded_integral(wanted) : integral(wanted, std::numeric_limits<double>::infinity());
  };
  std::vector<double> sum = integrated();
  while (2 * sum.back() > kFraction.steepest * parts) {
    for (Zone& z : wanted) z.core *= kFraction.widening;
    sum = integrated();
  }
  std::vector<double> fractions(static_cast<std::size_t>(parts) + 1);
  fractions.back() = 1;
  for (int k = 1; 2 * k <= parts; ++k) {
    const double target = sum.back() * 2 * k / parts;
    const auto above = std::lower_bound(sum.begin() + 1, sum.end() - 1, target);
    const double inside = (target - *(above - 1)) / (*above - *(above - 1));
    const double s = 0.5 * (static_cast<double>(above - sum.begin()) - 1 + inside) / kFraction.samples;
    fractions[static_cast<std::size_t>(parts - k)] = 1 - s;
    fractions[static_cast<std::size_t>(k)] = 2 * k == parts ? 0.5 : s;
  }
  return fractions;
}

std::vector<double> with_middles(const std::vector<double>& ends) {
  std::vector<double> all{ends.front()};
  for (std::size_t k = 1; k < ends.size(); ++k) {
    all.push_back((ends[k - 1] + ends[k]) / 2);
    all.push_back(ends[k]);
  }
  return all;
}

std::vector<double> divided_like(const std::vector<double>& ends, int parts) {
  const double whole = static_cast<double>(ends.size() - 1);
  std::vector<double> result;
  for (int k = 0; k < parts; ++k) {
    const double at = whole * k / parts;
    const std::size_t i = static_cast<std::size_t>(at);
    const double inside = at - static_cast<double>(i);
    result.push_back(inside == 0 ? ends[i] : ends[i] + inside * (ends[i + 1] - ends[i]));
  }
  result.push_back(ends.back());
  return result;
}

}  // namespace dovetail::geometry
