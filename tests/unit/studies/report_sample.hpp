#pragma once

#include "studies/report/record/run_record.hpp"

namespace dovetail::report {

/// A small run of two variables and one limit with every piece filled; no physics behind its numbers.
[[nodiscard]] RunRecord sample_record();

/// The same with two objectives, each for itself: the start and the last candidate are its front.
[[nodiscard]] RunRecord sample_front();

/// One design of it, `depth_um` deep at the neck side of both flanks.
[[nodiscard]] DesignRecord sample_design(double depth_um);

}  // namespace dovetail::report
