#include "optimizer/candidate/cell_grid.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "geometry/mesh/flank_fractions.hpp"
#include "optimizer/candidate/params.hpp"
#include "optimizer/scene/scene_kind.hpp"

namespace dovetail::optimizer {

CellLengths cell_lengths(const Scene& scene, CellLengths lengths) {
  if (!scene.kind->contact_grid || scene.solid_mesh.contact_flank_elements == 0) return lengths;
  const double longer = static_cast<double>(scene.mesh.flank_elements) / scene.solid_mesh.contact_flank_elements;
  lengths.finest *= longer;
  lengths.coarsest *= longer;
  return lengths;
}

EdgeLengths::EdgeLengths(const fem::TraceLines& lines) {
  for (std::size_t i = 2; i < lines.across.size(); i += 2) {
    middles_.push_back(lines.across[i - 1]);
    lengths_.push_back(lines.across[i] - lines.across[i - 2]);
  }
}

double EdgeLengths::at(double place) const {
  const auto above = std::upper_bound(middles_.begin(), middles_.end(), place);
  if (above == middles_.begin()) return lengths_.front();
  if (above == middles_.end()) return lengths_.back();
  const auto k = static_cast<std::size_t>(above - middles_.begin());
  const double t = (place - middles_[k - 1]) / (middles_[k] - middles_[k - 1]);
  return (1 - t) * lengths_[k - 1] + t * lengths_[k];
}

std::vector<double> cell_ends(const EdgeLengths& edge_lengths, const std::vector<double>& edges,
                              const CellLengths& lengths, std::vector<int>& counts) {
  const auto wanted = [&](double s) {
    double length = lengths.coarsest * edge_lengths.at(s);
    const auto grow_from = [&](double place) {
      length = std::min(length, lengths.finest * edge_lengths.at(place) + lengths.growth * std::abs(s - place));
    };
    grow_from(0);
    grow_from(1);
    for (const double edge : edges) grow_from(edge);
    return length;
  };
  std::vector<double> fixed{0};
  for (const double edge : edges) fixed.push_back(edge);
  fixed.push_back(1);
  const bool again = counts.size() + 1 == fixed.size();
  counts.resize(fixed.size() - 1);
  std::vector<double> ends{0};
  constexpr CellGridParams kParams;
  constexpr int kSteps = kParams.steps;
  for (std::size_t p = 0; p + 1 < fixed.size(); ++p) {
    const double from = fixed[p], piece = fixed[p + 1] - from;
    std::vector<double> cells(kSteps + 1, 0.0);
    for (int k = 0; k < kSteps; ++k)
      cells[static_cast<std::size_t>(k) + 1] =
          cells[static_cast<std::size_t>(k)] + piece / kSteps / wanted(from + piece * (k + 0.5) / kSteps);
    const auto place = [&](double at) {
      const auto above = std::upper_bound(cells.begin(), cells.end() - 1, at);
      const double step =
          static_cast<double>(above - cells.begin()) - 1 + (at - *(above - 1)) / (*above - *(above - 1));
      return from + piece * step / kSteps;
    };
    // Whole cells from both ends; what is left over in the middle, up to a cell and a bit, is a cell of its own.
    // So its number changes in the middle, where cells are longest and the contact changes least, and nowhere else.
    const double total = cells.back();
    int& count = counts[p];
    const int asked = std::max(1, static_cast<int>(std::ceil(total - kParams.bit)));
    if (!again || std::abs(count - asked) > 1) count = asked;
    const int before = count / 2, after = count - 1 - before;
    const double scale = std::min(1.0, total / (count - 1 + kParams.bit));
    for (int c = 1; c <= before; ++c) ends.push_back(place(c * scale));
    for (int c = after; c >= 1; --c) ends.push_back(place(total - c * scale));
    ends.push_back(fixed[p + 1]);
  }
  return ends;
}

std::vector<fem::FlankCells> cell_grid(const Scene& scene, const fem::SectorMesh& trace, const CellLengths& lengths) {
  std::vector<fem::FlankCells> cells;
  for (const fem::Flank& flank : trace.flanks) {
    const fem::TraceLines lines = fem::trace_lines(flank);
    fem::FlankCells of_flank{.along = {0, 1}, .across = {}};
    if (lines.along.size() > 1)
      of_flank.along = scene.solid_mesh.contact_slot_elements > 0
                           ? geometry::divided_like(lines.along, scene.solid_mesh.contact_slot_elements)
                           : lines.along;
    std::vector<int> counts;
    of_flank.across.assign(of_flank.along.size() - 1, cell_ends(EdgeLengths(lines), {}, lengths, counts));
    cells.push_back(std::move(of_flank));
  }
  return cells;
}

}  // namespace dovetail::optimizer
