#include "wear/node_line.hpp"

#include <algorithm>
#include <map>
#include <utility>

namespace dovetail::wear {

std::vector<NodeLine> flank_lines(const reduction::ContactNodes& contact) {
  const Eigen::Index count = contact.count();
  if (contact.directions() != 2 || contact.position.rows() != count || contact.group.size() != count) return {};
  std::map<int, std::vector<int>> flanks;
  for (Eigen::Index i = 0; i < count; ++i) flanks[contact.group[i]].push_back(static_cast<int>(i));
  std::vector<NodeLine> lines;
  for (auto& [flank, nodes] : flanks) {
    const Eigen::MatrixXd place = contact.position(nodes, Eigen::all);
    Eigen::Index axis = 0;
    (place.colwise().maxCoeff() - place.colwise().minCoeff()).maxCoeff(&axis);
    std::ranges::stable_sort(nodes, {}, [&](int node) { return contact.position(node, axis); });
    NodeLine line{.nodes = std::move(nodes), .ends = {0.0}};
    for (const int node : line.nodes) line.ends.push_back(line.ends.back() + contact.area[node]);
    lines.push_back(std::move(line));
  }
  return lines;
}

}  // namespace dovetail::wear
