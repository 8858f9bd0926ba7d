#include "geometry/mesh/contact_grid.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <iterator>

#include "geometry/mesh/index.hpp"
#include "geometry/mesh/params.hpp"

namespace dovetail::geometry {
namespace {

/// The part between `node` and `node + 1` a point is in, and its fraction there.
struct Place {
  int node = 0;
  double fraction = 0;
};

Place place(const std::vector<double>& nodes, double x) {
  if (nodes.size() < 2) return {};
  const auto above = std::upper_bound(nodes.begin() + 1, nodes.end() - 1, x);
  const int node = static_cast<int>(above - nodes.begin()) - 1;
  const double fraction = (x - nodes[index(node)]) / (nodes[index(node + 1)] - nodes[index(node)]);
  assert(fraction > -1e-9 && fraction < 1 + 1e-9);
  // A point that is a contact node up to rounding is that node.
  constexpr double kRounding = SizeParams{}.rounding;
  if (fraction < kRounding) return {node, 0};
  if (fraction > 1 - kRounding) return {node, 1};
  return {node, fraction};
}

}  // namespace

Eigen::SparseMatrix<double> bilinear_interpolation(const std::vector<double>& across, const std::vector<double>& along,
                                                   const std::vector<double>& points_across,
                                                   const std::vector<double>& points_along) {
  const int width = static_cast<int>(across.size());
  const int count = width * static_cast<int>(along.size());
  std::vector<Eigen::Triplet<double>> weights;
  int row = 0;
  for (const double z : points_along) {
    const Place second = place(along, z);
    for (const double s : points_across) {
      const Place first = place(across, s);
      for (int j = 0; j < 2; ++j)
        for (int i = 0; i < 2; ++i) {
          const double weight =
              (i == 0 ? 1 - first.fraction : first.fraction) * (j == 0 ? 1 - second.fraction : second.fraction);
          if (weight > 0) weights.emplace_back(row, first.node + i + width * (second.node + j), weight);
        }
      ++row;
    }
  }
  Eigen::SparseMatrix<double> result(row, count);
  result.setFromTriplets(weights.begin(), weights.end());
  return result;
}

std::vector<double> equal_fractions(int parts) {
  std::vector<double> fractions(index(parts) + 1);
  for (int i = 0; i <= parts; ++i) fractions[index(i)] = static_cast<double>(i) / parts;
  return fractions;
}

}  // namespace dovetail::geometry
