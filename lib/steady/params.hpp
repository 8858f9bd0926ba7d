#pragma once

#include <array>

namespace dovetail::steady {

// The numbers that say what rounding hides of a steady state, and what is worth keeping. All are relative. Double
// precision leaves about 1e-16 times the condition of what is solved, so that they stand in this order:
// 1e-15 < singular < 1e-13 < held < 1e-7 < largest floor < tolerances asked for.

/// When equations have no unique solution.
struct SingularityParams {
  /// Reciprocal condition of the dynamic stiffness of separated nodes, and of the Jacobian, below which it is told from
  /// a singular one by rounding alone.
  double singular = 1e-15;
  /// The same of the Jacobian at a solution: a body that nothing holds can be moved until its residual is small.
  double floats = 1e-13;
  /// Mean opening of a node, over the root of the area of all nodes, beyond which a state that spin softening allows is
  /// none: the blade is out of its slot. That is about a millimetre, and flanks open by hundredths of one.
  double out_of_slot = 0.05;
  double held = 1e-11;  ///< shift of the static stiffness: rounding turns no stiffness into a slightly negative one
  double safe_pivots = 1e-7;  ///< ratio of pivots above which a condition number need not be computed
  double regularised = 1e-6;  ///< shift of a singular Jacobian that gives Newton's method a direction
  /// Least stretch of a product of a Jacobian with the inverse of one near by from which on the one is as regular as
  /// the other. Smaller: a body that is about to float passes; larger: more is factorised.
  double safe_stretch = 1e-6;
  double same = 1e-13;  ///< entries of two Jacobians, or of D and the identity, that differ by less are one
};

/// The floor that rounding sets under residuals, see rounding_floor.
struct FloorParams {
  double rounding = 4e-15;  ///< of the forces that cancel: some twenty roundings
  /// The residual asked for is raised to the floor of the start up to this: a start at which rounding swamps the
  /// excitation is no measure of the solution. A solution with a floor above it is none.
  double largest = 1e-6;
};

/// What costs decide.
struct WorkParams {
  /// Operations of a march per node, sample and direction that a factorisation must exceed before kept factors are
  /// tried first. Measured: below, a chord step saves less than the residuals that it costs.
  double march_for_chord = 2e3;
  /// What products with a Jacobian and solves with the factors of one near by may cost, over a factorisation, before it
  /// is factorised; and how many there may be. Fewer: more is factorised; more: more is tried in vain.
  double products = 0.7, most_products = 60;
  double product = 18;  ///< operations per entry of the factors, and of the stiffness, that a product reads; measured
  /// Residual of a Newton step found in that way, relative, at most; and where the goal is near, that part of it.
  double loosest_step = 1e-2, of_goal = 0.1;
  /// Residual of what is solved for in that way, relative. Derivatives inherit it.
  double product_tolerance = 1e-10;
  double march_step = 200;        ///< operations per sample of a march,
  double march_coefficient = 75;  ///< and per sample and coefficient of its derivative; measured
};

/// The march at contact nodes.
struct MarchParams {
  /// Of the tolerance of the residual: forces of the contact may be far larger than the excitation that it is measured
  /// by.
  double share = 0.1;
};

/// How a load level is found that no start leads to directly.
struct PreloadParams {
  /// Springs that pull the contact back to where it starts, over the largest local contact stiffness: they keep a
  /// floating body near its slot. Taken away in these steps they lead to the state in which the contact alone holds it.
  std::array<double, 7> springs{1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7};
  double whole = 1e-9;  ///< a level this close to the whole load is the whole load: steps add up with roundings
};

static_assert(SingularityParams{}.singular < SingularityParams{}.floats, "a solution is judged more strictly");
static_assert(SingularityParams{}.floats < SingularityParams{}.held, "the static stiffness is rounded more often");
static_assert(SingularityParams{}.singular < SingularityParams{}.safe_pivots, "pivots only save the condition number");
static_assert(SingularityParams{}.floats < SingularityParams{}.regularised, "a regularised Jacobian is regular");
static_assert(PreloadParams{}.springs.back() > SingularityParams{}.held, "the last spring is felt, rounding is not");
static_assert(MarchParams{}.share < 1, "marches are closer than the residual");

}  // namespace dovetail::steady
