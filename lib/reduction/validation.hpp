#pragma once

#include <string>
#include <vector>

#include "core/errors.hpp"
#include "reduction/full_model.hpp"
#include "reduction/reduced_model.hpp"

namespace dovetail::reduction {

/// Everything wrong with a reduced model: shapes, finite values, symmetry (to 1e-9 of the largest entry),
/// negative masses on the diagonal, contact indices out of range or used twice, area > 0, friction and wear
/// coefficient >= 0, the wear law, output names. Keys are the data sets of the reduced model file ("/contact/area").
[[nodiscard]] std::vector<Violation> violations(const ReducedModel& model);

/// A wear law that there is not, or a threshold although the law has none: it would be left aside. Keys begin with
/// `section`. Part of the above.
[[nodiscard]] std::vector<Violation> wear_law_violations(const ContactNodes& contact, const std::string& section);

/// Sizes of a full model that do not fit together, and contact dofs that are not the last ones in the order
/// N, T1[, T2] of each node in turn.
[[nodiscard]] std::vector<Violation> violations(const FullModel& model);

}  // namespace dovetail::reduction
