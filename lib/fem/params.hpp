#pragma once

#include <cstddef>

namespace dovetail::fem {

// The numbers that tell rounding from structure in finite elements.

/// What meshes and contact grids must keep, whoever made them. Looser: joints that do not fit are computed without a
/// word; tighter: the rounding of their coordinates is taken for a misfit.
struct MatchingParams {
  double weights = 1e-9;  ///< of the sum of a pair's weights, from 1, and of the flank's frame, from orthonormal
  double image = 1e-7;    ///< distance of a cut's node from its partner's image, over its distance from the axis
};

/// Frequencies over nodal diameters from a basis of modes.
struct DiameterBasisParams {
  double rounding = 1e-14;  ///< entries of a transformation below it are none: it is made of cosines and sines
  /// Length, of a unit vector, beyond the basis above which it is a new direction: what is left of others is rounding,
  /// magnified by the Gram-Schmidt steps. Smaller: noise makes the reduced mass singular; larger: a needed direction is
  /// lost and more rounds are needed.
  double fresh = 1e-7;
  /// Of modes of the real phases, of the tolerance of frequencies: these err by about the square of it.
  double modes_tolerance = 1;
  int spare = 3;         ///< modes beyond those asked for that are followed: one that comes down is not missed
  int rounds = 12;       ///< of residuals at one diameter; then its sparse problem is solved
  double settled = 0.5;  ///< of the tolerance, by which values of a diameter may change in its last round
  std::size_t few = 3;   ///< diameters that are all solved: two ends and a sample between them leave none to save
};

static_assert(MatchingParams{}.weights < MatchingParams{}.image, "positions are rounded more than weights");
static_assert(DiameterBasisParams{}.rounding < DiameterBasisParams{}.fresh, "rounding is no direction");

}  // namespace dovetail::fem
