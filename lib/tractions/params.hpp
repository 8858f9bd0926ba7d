#pragma once

#include <cstddef>

namespace dovetail::tractions {

// The numbers that steer the search for bounds over residual tractions. They were tuned on punches and dovetail
// sections with 4 to 34 stuck nodes; sampling at random found no wider range there.
struct SearchParams {
  std::size_t climbs = 3;  ///< starts: the most promising ones, the others lead to the same ends more slowly
  int grid = 5;            ///< starts per direction where there are at most two unknowns
  int steps = 40;          ///< of one climb at most
  int polls = 3;           ///< rounds of single changes and random tractions, where nodes begin to slip
  int rounds = 3;          ///< of the search anew where other nodes stay stuck
  /// Of the way to the relaxed state: a node that stands at its limit is put a hair inside, lest rounding slips it.
  double inside = 1e-7;
  double nothing = 1e-10;  ///< stiffness, relative, of a direction that carries no residual traction
};
static_assert(SearchParams{}.nothing < SearchParams{}.inside, "what is put inside is more than rounding");

}  // namespace dovetail::tractions
