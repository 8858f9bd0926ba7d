#include "fem/contact_cells.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <string>

#include "core/errors.hpp"
#include "fem/flank_trace.hpp"
#include "fem/sector_system.hpp"

namespace dovetail::fem {

namespace {

using Weights = std::vector<double>;

/// Integrals over [from, to] of the Lagrange functions of the nodes `first`, `first + 1`, ... of one element, exact by
/// Simpson's rule up to quadratic ones.
void add_element(const std::vector<double>& nodes, std::size_t first, std::size_t count, double from, double to,
                 Weights& weights) {
  const double a = std::max(from, nodes[first]), b = std::min(to, nodes[first + count - 1]);
  if (!(b > a)) return;
  for (std::size_t i = 0; i < count; ++i) {
    const auto value = [&](double s) {
      double product = 1;
      for (std::size_t j = 0; j < count; ++j)
        if (j != i) product *= (s - nodes[first + j]) / (nodes[first + i] - nodes[first + j]);
      return product;
    };
    weights[first + i] += (b - a) / 6 * (value(a) + 4 * value((a + b) / 2) + value(b));
  }
}

/// Weights of the mean over [from, to] of a function given at `nodes`, in elements of `order`.
Weights mean_over(const std::vector<double>& nodes, std::size_t order, double from, double to) {
  Weights weights(nodes.size(), 0.0);
  if (nodes.size() == 1) return {1.0};
  for (std::size_t first = 0; first + order < nodes.size(); first += order)
    add_element(nodes, first, order + 1, from, to, weights);
  for (double& weight : weights) weight /= to - from;
  return weights;
}

void check(const std::vector<double>& ends, const std::string& key) {
  const bool rises =
      ends.size() >= 2 && std::adjacent_find(ends.begin(), ends.end(), std::greater_equal<>()) == ends.end();
  if (!rises || ends.front() != 0.0 || ends.back() != 1.0)
    throw InputError(
        {.file = {}, .key = key, .value = std::to_string(ends.size()) + " ends", .allowed = "must rise from 0 to 1"});
}

/// Area of the whole flank, m^2.
double flank_area(const SectorMesh& sector, const Flank& trace) {
  const Eigen::VectorXd first = trace.position.col(0);
  const Eigen::VectorXd across = trace.position.col(trace.grid[0] - 1) - first;
  if (sector.mesh.dimensions() == 2) return across.norm() * body_thickness(sector.mesh, trace.pairs.front()[0]);
  const Eigen::VectorXd along = trace.position.col(trace.grid[0] * (trace.grid[1] - 1)) - first;
  return Eigen::Vector3d(across).cross(Eigen::Vector3d(along)).norm();
}

}  // namespace

std::vector<CellStrip> ContactCells::strips() const {
  std::vector<CellStrip> found;
  std::size_t first = 0;
  for (std::size_t f = 0; f < flanks.size(); ++f)
    for (const std::vector<double>& ends : flanks[f].across) {
      found.push_back({.flank = f, .first = first, .ends = ends});
      first += ends.size() - 1;
    }
  return found;
}

ContactCells contact_cells(const SectorMesh& trace, const std::vector<FlankCells>& flanks) {
  ContactCells cells{.flanks = flanks, .average = {}, .area = {}, .position = {}, .gap = {}, .flank = {}, .strip = {}};
  if (flanks.size() != trace.flanks.size())
    throw InputError({.file = {},
                      .key = "cells",
                      .value = std::to_string(flanks.size()),
                      .allowed = "must be divided for each of the " + std::to_string(trace.flanks.size()) + " flanks"});
  std::vector<Eigen::Triplet<double>> weights;
  std::vector<double> area, gap;
  std::vector<int> of_flank, of_strip;
  std::vector<Eigen::VectorXd> position;
  int first_node = 0, strip = 0;
  for (std::size_t f = 0; f < flanks.size(); ++f) {
    const Flank& flank = trace.flanks[f];
    const std::string key = "cells." + flank.name;
    check(flanks[f].along, key + ".along");
    const TraceLines lines = trace_lines(flank);
    const double whole = flank_area(trace, flank);
    for (std::size_t j = 0; j + 1 < flanks[f].along.size(); ++j, ++strip) {
      const std::vector<double>& ends = flanks[f].across.at(j);
      check(ends, key + ".across");
      const double low = flanks[f].along[j], high = flanks[f].along[j + 1];
      const Weights along = mean_over(lines.along, 1, low, high);
      for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
        const Weights across = mean_over(lines.across, 2, ends[i], ends[i + 1]);
        const int row = static_cast<int>(area.size());
        Eigen::VectorXd middle = Eigen::VectorXd::Zero(trace.mesh.dimensions());
        double mean_gap = 0;
        for (std::size_t q = 0; q < along.size(); ++q)
          for (std::size_t p = 0; p < across.size(); ++p) {
            const double weight = across[p] * along[q];
            if (weight == 0) continue;
            const auto node = static_cast<int>(p + across.size() * q);
            weights.emplace_back(row, first_node + node, weight);
            middle += weight * flank.position.col(node);
            if (flank.gap.size() > 0) mean_gap += weight * flank.gap[node];
          }
        area.push_back(whole * (ends[i + 1] - ends[i]) * (high - low));
        gap.push_back(mean_gap);
        position.push_back(middle);
        of_flank.push_back(static_cast<int>(f));
        of_strip.push_back(strip);
      }
    }
    first_node += flank.contact_count();
  }
  const auto count = static_cast<Eigen::Index>(area.size());
  cells.average.resize(count, first_node);
  cells.average.setFromTriplets(weights.begin(), weights.end());
  cells.area = Eigen::Map<const Eigen::VectorXd>(area.data(), count);
  cells.gap = Eigen::Map<const Eigen::VectorXd>(gap.data(), count);
  cells.flank = Eigen::Map<const Eigen::VectorXi>(of_flank.data(), count);
  cells.strip = Eigen::Map<const Eigen::VectorXi>(of_strip.data(), count);
  cells.position.resize(trace.mesh.dimensions(), count);
  for (Eigen::Index k = 0; k < count; ++k) cells.position.col(k) = position[static_cast<std::size_t>(k)];
  return cells;
}

}  // namespace dovetail::fem
