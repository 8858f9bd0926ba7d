#pragma once

#include "studies/work_precision/evaluations/design.hpp"

namespace dovetail::work_precision {

/// The fixed settings of [Salles 2009], page 9, on the mesh and with the modes of the study's file, which the paper
/// does not give: 3 harmonics, 128 instants, hybrid Powell with the exact Jacobian.
[[nodiscard]] WholeSetting paper_setting(const optimizer::Scene& scene);

/// The paper's way to the worn state at those settings: the slip return of first order, and a history in explicit steps
/// of equal largest depth [eq. 21-22] at the unworn resonance, until nothing wears.
/// @param depth  m, W_tot of the paper, which it sets by hand: a reference's worn depth
/// @param steps  its k, which the paper does not give
[[nodiscard]] WholeRun paper_history(const MeasuredDesign& design, double depth, int steps);

}  // namespace dovetail::work_precision
