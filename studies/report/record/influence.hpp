#pragma once

#include <string>
#include <vector>

#include "studies/report/record/run_record.hpp"

namespace dovetail::report {

/// How a quantity goes with a variable over the range that was seen.
enum class Trend { rises, falls, valley, hill };

/// What one variable does to one quantity.
struct VariableInfluence {
  double share = 0;  ///< of the variance of the ranks, 0 to 1
  Trend trend = Trend::rises;
};

/// What the variables do to one quantity, as far as the candidates tell.
struct Influence {
  std::size_t candidates = 0;  ///< with a value
  double explained = 0;  ///< of the variance of the ranks by all variables, less what they explain of noise, 0 to 1
  std::vector<VariableInfluence> variables = {};  ///< in the order of the design space; empty: too few candidates
};

/// Fits the ranks of the values with a parabola in each variable, of ranks too, added up: r(y) = c + sum_i f_i(r(x_i)).
/// Ranks, because responses range over decades and candidates crowd around the best one. A variable's share is its part
/// of the fit's variance, cov(f_i, fit) / var(r(y)), where that is above 0; they are scaled to add up to `explained`,
/// as those of candidates that vary several variables at once do not. Needs four candidates for each variable and two
/// more.
/// @param values  one for each candidate of the run; NaN: not computed
[[nodiscard]] Influence influence(const RunRecord& record, const Numbers& values);

}  // namespace dovetail::report
