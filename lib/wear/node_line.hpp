#pragma once

#include <vector>

#include "reduction/reduced_model.hpp"

namespace dovetail::wear {

/// Contact nodes side by side across a flank, in their order. A node on no line has no neighbours.
struct NodeLine {
  std::vector<int> nodes;
  std::vector<double> ends;  ///< [nodes + 1] rising: node k reaches from ends[k] to ends[k + 1], in the line's own unit

  [[nodiscard]] std::size_t count() const { return nodes.size(); }
  [[nodiscard]] double length(std::size_t k) const { return ends[k + 1] - ends[k]; }
};

/// A line for each flank of a plane model, in the order of its nodes along its longer extent; nodes are as long as
/// their areas. None where positions or flanks are not known, and none in space: there the nodes of a flank cover a
/// surface, and which of them follow one another across the slot is not in the model.
[[nodiscard]] std::vector<NodeLine> flank_lines(const reduction::ContactNodes& contact);

}  // namespace dovetail::wear
