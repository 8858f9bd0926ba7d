#pragma once

#include <vector>

#include "fem/contact_cells.hpp"
#include "wear/node_line.hpp"

namespace dovetail::optimizer {

/// The strips of contact cells as lines of contact nodes; ends as fractions of the flank.
[[nodiscard]] std::vector<wear::NodeLine> node_lines(const fem::ContactCells& cells);

}  // namespace dovetail::optimizer
