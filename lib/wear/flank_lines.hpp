#pragma once

#include <vector>

#include "reduction/reduced_model.hpp"

namespace dovetail::wear {

/// The nodes of each flank in their order along it: nodes of one group by their place on the flank's longest direction
/// (by index where positions are missing). Plane models only.
[[nodiscard]] std::vector<std::vector<int>> flank_lines(const reduction::ContactNodes& contact);

}  // namespace dovetail::wear
