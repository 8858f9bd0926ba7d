#pragma once

namespace dovetail::optimizer {

// The numbers that steer where contact nodes are laid, tuned on dovetail sections of 16 to 48 edges per flank, and what
// a model is made of.

/// How a piece of a flank is divided into contact cells.
struct CellGridParams {
  int steps = 400;   ///< of the integral of 1 / length over a piece; fewer: cells off the lengths asked for
  double bit = 0.2;  ///< cell that may be left over before there is one more; 0: one more for a rounding
};

/// How the ends of cells are brought to the edges of worn zones, lengths of the mesh's edge there.
struct EdgeSearchParams {
  double narrowest = 0.3;  ///< zone, of the finest cell, that the trace resolves
  double rounding = 1e-9;  ///< of a flank: places closer than that are one
  double beyond = 0.05;    ///< by which an edge that grew goes on first, twice as far each further time
  /// Slopes of found - laid between which the secant is followed: -1 is that of edges that do not depend on the grid.
  /// Wider: an edge that was mistaken for another is sent far away.
  double flattest = -0.5, steepest = -4;
};

/// When rough flanks are too soft for nodes that stay matched.
struct AsperityParams {
  double large = 0.1;  ///< way that asperities give or flanks slide under the pull of the blade, of a flank's length
};

/// What is kept of matrices for designs that share them.
struct MatricesParams {
  double largest_fields = 1e8;  ///< numbers: 800 MB. Larger ones take longer than matrices of its own for each design
};

/// At which instants a stress is looked at.
struct StressParams {
  int phases = 48;  ///< of a period: the error of a peak is under (pi / 48)^2 / 2 = 0.2 % of the vibratory part
};

static_assert(CellGridParams{}.bit < 1, "a whole cell is not left over");
static_assert(EdgeSearchParams{}.steepest < -1 && -1 < EdgeSearchParams{}.flattest,
              "the slope of edges that stay is followed");
static_assert(EdgeSearchParams{}.rounding < 1e-3 * EdgeSearchParams{}.narrowest, "what counts as one place is no zone");
static_assert(AsperityParams{}.large < 1, "nodes leave the flank");
static_assert(EdgeSearchParams{}.beyond < EdgeSearchParams{}.narrowest, "an edge goes on by less than a zone");

}  // namespace dovetail::optimizer
