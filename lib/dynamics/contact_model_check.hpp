#pragma once

#include "reduction/reduced_model.hpp"

namespace dovetail::dynamics {

/// Throws InputError listing everything in `model` that does not fit together.
void check(const reduction::ReducedModel& model);

}  // namespace dovetail::dynamics
