#include "optimizer/candidate/node_lines.hpp"

#include <numeric>

namespace dovetail::optimizer {

std::vector<wear::NodeLine> node_lines(const fem::ContactCells& cells) {
  std::vector<wear::NodeLine> lines;
  for (const fem::CellStrip& strip : cells.strips()) {
    wear::NodeLine& line = lines.emplace_back();
    line.nodes.resize(strip.count());
    std::iota(line.nodes.begin(), line.nodes.end(), static_cast<int>(strip.first));
    line.ends = strip.ends;
  }
  return lines;
}

}  // namespace dovetail::optimizer
