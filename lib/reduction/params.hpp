#pragma once

#include <Eigen/Core>
#include <cstdint>

namespace dovetail::reduction {

// The numbers that tell rounding from stiffness in a reduction, and what files may hold. Double precision leaves about
// 1e-16 times the condition of what is solved; the relations are asserted below.

/// Bodies that float, and their modes.
struct FloatingParams {
  /// Stiffness of a direction of the Schur complement, over its largest, that is none. The elimination leaves rounding
  /// of some 1e-13; the rigid stiffness that spin softening leaves at speed is above 1e-9. Smaller: rigid modes are
  /// inverted; larger: spin-softened ones are taken for rigid.
  double rigid = 1e-11;
  /// How such directions are found. From so many rows on by a Krylov method: measured, a decomposition takes as long
  /// at 400 rows, four times as long at 1500. On the complement plus this part of its largest: far above what is rigid,
  /// far below what is elastic. At first so many pairs: one more than a body has rigid ones. To this residual: smaller
  /// ones cost restarts and gain little.
  Eigen::Index krylov_from = 400;
  double lift = 1e-6;
  int soft_pairs = 7;
  double soft_tolerance = 1e-10;
  /// Modes that are asked for in search of negative ones, over those first asked for, and in any case. Fewer: negative
  /// modes behind many elastic ones are not found; more: work for models that have none.
  Eigen::Index search_range = 4, search_always = 100;
  int vector_limit = 20;  ///< solves per mode wanted: twice the usual, stiffnesses that float converge more slowly
  /// Eigenvalue, over the last one kept, up to which a mode is soft: its response is so large that it would cancel in
  /// differences. Larger: modes that have not converged as far are taken for exact.
  double soft = 1e-3;
};

/// Static responses to loads.
struct ResponseParams {
  double dependent = 1e-12;  ///< part of a unit load beyond the others that is rounding
  /// Energy of a response beyond the modes, over the whole, that counts as represented: 1e-10 in displacement.
  double negligible = 1e-20;
  double parallel = 1e-9;  ///< part of a unit response beyond the earlier ones that is rounding of the solves
};

/// Reciprocal condition of the flexibility of the contact below which too many modes are kept: the basis then moves the
/// contact in every way that there is, and what is left is rounding.
struct FlexibilityParams {
  double singular = 1e-14;
};

/// A small change of the stiffness after a reduction.
struct ChangeParams {
  /// Entry, over the largest, up to which it does not act on fields of contact forces. Larger: less work; what is left
  /// out is that part of a change whose square is left out anyway.
  double negligible = 3e-4;
};

/// What models from files must keep.
struct ModelFileParams {
  double asymmetry = 1e-9;       ///< of a matrix, over its largest entry: what exporters that print few digits leave
  std::int64_t largest = 20000;  ///< rows or columns: 3.2 GB as a dense matrix
  /// Stiffness of a degree of freedom, in a structure's own unit, from which on it is held: Abaqus writes 1e36. Far
  /// above any that a body has.
  double held = 1e30;
};

static_assert(FloatingParams{}.rigid < FloatingParams{}.soft, "rigid modes are soft");
static_assert(FloatingParams{}.rigid < 1e-3 * FloatingParams{}.lift, "what is rigid stands out in the inverse");
static_assert(FlexibilityParams{}.singular < FloatingParams{}.rigid, "what is no stiffness is above rounding");
static_assert(ResponseParams{}.negligible <= ResponseParams{}.parallel * ResponseParams{}.parallel,
              "what is represented is not kept for its direction");
static_assert(ResponseParams{}.dependent < ResponseParams{}.parallel, "loads are rounded less than their responses");

}  // namespace dovetail::reduction
