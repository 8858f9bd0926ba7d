#pragma once

namespace dovetail::geometry {

// Lengths that say what is resolved of a section, m unless said otherwise. Physical ones name the load they are for.

/// Questions that are answered in exact arithmetic, see exact_section.hpp.
struct ExactParams {
  double snap = 1e-12;  ///< grid of the end points: doubles of some decimetres are rounded to 1e-16
  /// Area that rounding to the grid can produce along a boundary of 1 m, m2: overlaps up to this are none.
  double noise = 2e-12;
};

/// The rounding of a flank's end, see flank_form.hpp.
struct EdgeParams {
  /// How far it has fallen behind the flank where the flank ends. The contact ends where it has fallen by about 0.3 um
  /// (R = 1 mm) to 1.2 um (R = 50 mm) under 80 MPa on titanium; the rest is room for loads that press one end more.
  double drop = 5e-6;
};

/// What of a fillet's stress is the fillet's: nothing up to `from` and all beyond `to`, distances from the flank's end
/// in radii. A wider step leaves less of the fillet, a narrower one is steeper in the design.
struct FilletShareParams {
  double from = 0.2, to = 0.35;
};

/// Arcs that stand for a flank with its form.
struct FinishedParams {
  double error = 0.05e-6;     ///< largest distance between form and arcs, far below any tolerance of manufacture
  double straight = 0.01e-6;  ///< bulges below this are lines: arcs of some hundred metres radius help nobody
  double shortest = 1e-9;     ///< pieces shorter than this are rounding of a border
  int halvings = 12;          ///< of a piece at most
  int places = 32;            ///< of a piece at which the distance is looked at
};

static_assert(ExactParams{}.noise >= ExactParams{}.snap, "rounding along 1 m");
static_assert(FilletShareParams{}.from < FilletShareParams{}.to, "a step with a width");
static_assert(FinishedParams{}.straight < FinishedParams{}.error, "a line is as good as an arc");
static_assert(FinishedParams{}.shortest > ExactParams{}.snap, "pieces that are left are resolved");
static_assert(FinishedParams{}.error < EdgeParams{}.drop, "the rounding is drawn");

}  // namespace dovetail::geometry
