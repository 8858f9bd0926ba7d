#pragma once

namespace dovetail::stability {

// The numbers that say what rounding and sampling hide of a perturbed motion.
struct StabilityParams {
  double settled = 1e-6;  ///< slip of a period, over the friction limit, that a march leaves of a shakedown
  double largest_turn =
      0.5;                  ///< of the slip direction in a sample, rad: where the limit vanishes its rate says nothing
  double step = 1e-9;       ///< of an interval between events, that is no way left to go
  double regular = 1e-13;   ///< reciprocal condition of the equations of a mode
  double nothing = 1e-12;   ///< of the largest mass or stiffness, that counts as none,
  double diagonal = 1e-14;  ///< and of entries beside a diagonal
};
static_assert(StabilityParams{}.diagonal < StabilityParams{}.nothing, "an exact structure is told from a soft one");

}  // namespace dovetail::stability
