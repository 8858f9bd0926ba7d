#pragma once

#include "steady/joint.hpp"

namespace dovetail::wear {

/// Throws InputError when a computation that finds out which nodes wear off starts with some released.
void require_nothing_released(const steady::Condition& start);

}  // namespace dovetail::wear
