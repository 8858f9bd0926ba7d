#pragma once

#include <span>

#include "optimizer/problem/load_case.hpp"

namespace dovetail::optimizer {

/// What nobody knows better of a joint in service, a case each: how far does a design hold there?
[[nodiscard]] std::span<const LoadCase> usual_departures();

}  // namespace dovetail::optimizer
