#pragma once

namespace dovetail::tractions {

// The numbers that steer the search for bounds over residual tractions. They were tuned on punches and dovetail
// sections with 4 to 34 stuck nodes; sampling at random found no wider range there.
struct SearchParams {
  int rounds = 4;             ///< families searched: those around the best member found, where other nodes stay stuck
  double global_share = 0.5;  ///< of the solves that are left, for climbs along gradients from many starts,
  double local_share = 0.5;   ///< and of the rest for a search without gradients, which kinks need
  double climb_gain = 1e-6;   ///< relative, below which a climb ends,
  double climb_step = 1e-4;   ///< and the same of tractions
  double nothing = 1e-10;     ///< stiffness, relative, of a direction that carries no residual traction
};
static_assert(SearchParams{}.global_share + SearchParams{}.local_share <= 1, "every round leaves some for the next");

}  // namespace dovetail::tractions
