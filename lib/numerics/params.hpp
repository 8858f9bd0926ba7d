#pragma once

#include <Eigen/Core>

namespace dovetail::numerics {

// The numbers that steer methods of linear algebra. Those of Newton's and Powell's methods are options of their
// callers and stand in their headers.

/// How a sparse factor is applied to many columns.
struct FactorParams {
  /// Columns carried through at once: enough for matrix-matrix BLAS, little enough for the cache. At 16 000 unknowns
  /// times are flat within 3 % from 16 to 200 columns, at 74 000 they still fall by a tenth from 32 to 64.
  Eigen::Index columns = 64;
};

/// When an order by minimum degree is not taken at once.
struct OrderParams {
  /// Operations per entry of the factor from which nested dissection, which takes longer, is tried as well: CHOLMOD's
  /// number. Few entries serve many operations where separators are large: in space, and on fine meshes.
  double dissect = 500;
};

/// The border of a partial factorisation, which is shifted until it is positive definite. A shift too small costs a
/// factorisation, one too large leaves the Schur complement its ratio to the shift in rounding.
struct BorderParams {
  int attempts = 6;     ///< of factorisations; the first with the mean of the border's diagonal as shift,
  double growth = 100;  ///< each with so many times the one before
};

/// How smallest_modes looks for a shift below all eigenvalues.
struct ShiftParams {
  /// Reciprocal condition below which a factor is that of a singular matrix with pivots of rounding: its inverse would
  /// drown the other modes. Some hundred roundings; larger: soft but well-posed structures are shifted, too.
  double singular = 1e-14;
  /// The first shift below zero, over the largest K_ii/M_ii: above the rounding of K, far below its first mode.
  double first = 1e-10;
  double growth = 100;  ///< each is so many times the one before
  int attempts = 6;
};

/// The block Krylov method. Tuned on sections, sectors and beams of 1 000 to 300 000 unknowns.
struct ModesParams {
  /// Vectors at once: more than any multiplicity of a blade's or a sector's frequencies. From `large` unknowns on,
  /// whose factors are read from memory for every solve, more of them cost next to nothing.
  int block = 6, large_block = 16;
  Eigen::Index large = 30000;
  int vectors = 3, blocks = 5;  ///< the space holds so many vectors per mode wanted, and so many blocks besides
  Eigen::Index always = 400;    ///< solves that are allowed always
  /// Length, over that of the block, below which a direction of it is rounding: of a first image, of what is left of
  /// one, and when it is made orthonormal once more, as a Gram matrix squares the condition of a block.
  double independent = 1e-12, remainder = 1e-13, second = 1e-3;
  double range = 1e14;  ///< between values of 1/(lambda - sigma): those beyond belong to no finite eigenvalue
};

static_assert(BorderParams{}.growth > 1 && ShiftParams{}.growth > 1, "shifts grow");
static_assert(ShiftParams{}.singular < ShiftParams{}.first, "the first shift makes a factor regular");
static_assert(ModesParams{}.block <= ModesParams{}.large_block, "larger blocks where they cost nothing");
static_assert(ModesParams{}.blocks > 2, "a restart keeps one block besides the modes and adds another");
static_assert(ModesParams{}.remainder <= ModesParams{}.independent, "what is left of an image is smaller than it");
static_assert(ModesParams{}.independent < ModesParams{}.second, "what was made orthonormal once nearly is so");

}  // namespace dovetail::numerics
