#pragma once

namespace dovetail::dynamics {

// The numbers that say what rounding hides of a condensed model. All are relative.

/// What counts as no mass, as diagonal, as singular.
struct CondensationParams {
  /// Mass, over the largest, that is none: matrices that were rotated carry some hundred roundings. Larger: light but
  /// real masses are dropped; smaller: massless coordinates get frequencies of 1e6 times the others.
  double massless = 1e-13;
  double diagonal = 1e-14;  ///< entries beside the diagonal, by the norm, of matrices that are modal as they come
  /// Damping beside the diagonal, over the geometric mean of its diagonal entries, of modal damping that was rotated.
  /// Larger: couplings are dropped; smaller: every frequency costs a factorisation that it does not need.
  double modal_damping = 1e-9;
  /// Reciprocal condition from which on the mass, and else the stiffness, serves as metric of the modes. Stiffness may
  /// be worse: its range is that of the squared frequencies.
  double mass_metric = 1e-12, stiffness_metric = 1e-14;
  double resonance = 1e-16;  ///< reciprocal condition of the dynamic stiffness below which it is that of a resonance
};

/// Extremes of a trigonometric polynomial of degree H.
struct ExtremesParams {
  /// Places per harmonic between which its slope is looked at. At most 2 H changes of sign lie among them: two in one
  /// interval are a pair of extremes that differ by less than 1e-3 of the highest harmonic's amplitude.
  int places = 16;
  int iterations = 60;   ///< as many halvings resolve any interval
  double angle = 1e-15;  ///< rad: closer places are the same
};

static_assert(CondensationParams{}.resonance < CondensationParams{}.stiffness_metric, "a metric is no resonance");
static_assert(CondensationParams{}.stiffness_metric <= CondensationParams{}.mass_metric, "the mass is tried first");
static_assert(CondensationParams{}.massless < CondensationParams{}.mass_metric, "a mass metric has no massless part");
static_assert(CondensationParams{}.diagonal < CondensationParams{}.modal_damping, "rotations round");
static_assert(ExtremesParams{}.places > 2, "more places than changes of sign");

}  // namespace dovetail::dynamics
