#pragma once

#include "studies/work_precision/evaluations/points.hpp"

namespace dovetail::work_precision {

/// The program's own choice for a design at an accuracy, as `[solver] accuracy` makes it where the study file gives no
/// mesh, harmonics, samples, modes and tolerance of resonances. Errors and comparison are the caller's.
/// @param limit  s of processor time: after the round that goes beyond it the choice is given up; 0: none
[[nodiscard]] AutomaticChoice choose(MeasuredDesign& design, double accuracy, double limit);

}  // namespace dovetail::work_precision
