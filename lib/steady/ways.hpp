#pragma once

#include <Eigen/Core>
#include <memory>
#include <string_view>

#include "steady/solve.hpp"

namespace dovetail::steady {

/// Ways to a steady state, in the order in which they are tried. From `open` on each starts from solutions of
/// neighbouring problems, cheapest first. All end with the problem as it was asked, at worst with another eps: the way
/// changes whether there is an answer and not what counts as one.
enum class Way {
  guess,            ///< from the displacement given
  closed,           ///< from closed contact
  other_penalty,    ///< with other eps, then with the one asked for from there
  powell,           ///< Powell's method from closed contact
  open,             ///< from the linear response without contact
  harmonics,        ///< the series grows from one harmonic to H
  growing_penalty,  ///< eps grows from a thousandth to its value
  frequency,        ///< omega falls from three times its value, above the resonances, with steps that shrink on failure
  damping,          ///< dashpots across the contact fade away; where steps fail, along the curve of solutions
  softer_damping,   ///< the same with a tenth of eps
  none,
};
[[nodiscard]] std::string_view to_string(Way way);

/// What the ways have come to.
struct Found {
  Attempt attempt;  ///< the last or the best one; its counts are those of all
  Way way = Way::none;
};

/// Tries the ways that the joint's options allow until one leads to a solution. `guess` and `reuse` may be empty.
/// Neighbouring problems spend at most `max_rescue_iterations` Jacobians, more by one attempt for each way.
[[nodiscard]] Found try_ways(const Joint& joint, const std::shared_ptr<const Problem>& problem,
                             const Eigen::MatrixXd& guess, const std::shared_ptr<const Tangent>& reuse);

}  // namespace dovetail::steady
