#include "wear/release/zone_edges.hpp"

#include <cmath>

#include "wear/params.hpp"

namespace dovetail::wear {

using Eigen::Index;

std::vector<ZoneEdge> zone_edges(const ReleaseTrail& trail, std::span<const NodeLine> lines,
                                 const Eigen::VectorXd& size) {
  std::vector<ZoneEdge> edges;
  for (std::size_t l = 0; l < lines.size(); ++l) {
    const std::vector<int>& line = lines[l].nodes;
    for (std::size_t k = 0; k + 1 < line.size(); ++k) {
      const auto pass_of = [&](std::size_t at) { return trail.released_in[static_cast<std::size_t>(line[at])]; };
      if ((pass_of(k) < 0) == (pass_of(k + 1) < 0)) continue;
      const bool rising = pass_of(k) >= 0;  // the zone is on the side of the first nodes
      const std::size_t at = rising ? k : k + 1;
      const int pass = pass_of(at), worn = line[at], bearing = line[rising ? k + 1 : k];
      const Eigen::VectorXd& reserve = trail.reserves[static_cast<std::size_t>(pass)];
      const double excess = -EdgeParams{}.excess * size[worn] / size[bearing] * reserve[worn],
                   margin = reserve[bearing];
      if (std::isnan(margin) || !(excess + margin > 0) || std::isinf(margin)) continue;
      std::size_t first = at;
      const auto has_next = [&] { return rising ? first > 0 : first + 1 < line.size(); };
      const auto next = [&] { return rising ? first - 1 : first + 1; };
      while (has_next() && pass_of(next()) == pass) first = next();
      const bool grown = has_next() && pass_of(next()) >= 0 && pass_of(next()) < pass;
      edges.push_back({.line = static_cast<int>(l),
                       .worn = worn,
                       .bearing = bearing,
                       .fraction = excess / (excess + margin),
                       .first = line[first],
                       .before = grown ? line[next()] : -1});
    }
  }
  return edges;
}

}  // namespace dovetail::wear
