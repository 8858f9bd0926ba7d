#pragma once

#include <cstddef>
#include <vector>

namespace dovetail::wear {

/// Contact nodes side by side across a flank, in their order. A node on no line has no neighbours.
struct NodeLine {
  std::vector<int> nodes;
  std::vector<double> ends;  ///< [nodes + 1] rising: node k reaches from ends[k] to ends[k + 1], in the line's own unit

  [[nodiscard]] std::size_t count() const { return nodes.size(); }
  [[nodiscard]] double length(std::size_t k) const { return ends[k + 1] - ends[k]; }
};

}  // namespace dovetail::wear
