#pragma once

#include "response/residual.hpp"

namespace dovetail::wear {

/// Throws InputError when a computation that finds out which nodes wear off starts with some released.
void require_nothing_released(const response::ContactCondition& start);

}  // namespace dovetail::wear
