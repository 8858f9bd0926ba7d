#include "optimizer/candidate/carried_over.hpp"

#include <algorithm>
#include <utility>

namespace dovetail::optimizer {

namespace {

/// The strip of `before` that lies where each of `after` does along the slot, on the same flank.
std::vector<std::size_t> nearest_strips(const std::vector<fem::CellStrip>& before,
                                        const std::vector<fem::CellStrip>& after) {
  // The first one and their number.
  const auto of_flank = [](const std::vector<fem::CellStrip>& strips, std::size_t flank) {
    const auto first = std::ranges::lower_bound(strips, flank, {}, &fem::CellStrip::flank);
    const auto last = std::ranges::upper_bound(strips, flank, {}, &fem::CellStrip::flank);
    return std::pair{static_cast<std::size_t>(first - strips.begin()), static_cast<std::size_t>(last - first)};
  };
  std::vector<std::size_t> nearest;
  for (std::size_t s = 0; s < after.size(); ++s) {
    const auto [first, count] = of_flank(after, after[s].flank);
    const auto [first_before, count_before] = of_flank(before, after[s].flank);
    nearest.push_back(first_before + (2 * (s - first) + 1) * count_before / (2 * count));
  }
  return nearest;
}

}  // namespace

Eigen::MatrixXd carried_over(const Eigen::MatrixXd& from, const std::vector<fem::CellStrip>& before,
                             const std::vector<fem::CellStrip>& after, Eigen::Index directions) {
  const std::vector<std::size_t> nearest = nearest_strips(before, after);
  const std::size_t cells = after.back().first + after.back().count();
  Eigen::MatrixXd to(static_cast<Eigen::Index>(cells) * directions, from.cols());
  const auto rows = [directions](std::size_t node) { return static_cast<Eigen::Index>(node) * directions; };
  for (std::size_t s = 0; s < after.size(); ++s) {
    const fem::CellStrip& old = before[nearest[s]];
    for (std::size_t cell = 0; cell < after[s].count(); ++cell) {
      const double at = after[s].middle(cell);
      std::size_t low = 0;
      while (low + 2 < old.count() && old.middle(low + 1) < at) ++low;
      const std::size_t high = std::min(low + 1, old.count() - 1);
      const double t =
          high == low ? 0 : std::clamp((at - old.middle(low)) / (old.middle(high) - old.middle(low)), 0.0, 1.0);
      to.middleRows(rows(after[s].first + cell), directions) =
          (1 - t) * from.middleRows(rows(old.first + low), directions) +
          t * from.middleRows(rows(old.first + high), directions);
    }
  }
  return to;
}

}  // namespace dovetail::optimizer
