#pragma once

namespace dovetail::geometry {

// The numbers that steer meshing, besides the sizes that a study sets (MeshSizes) and the limits of a moved mesh
// (MeshLimits). They were tuned on default sections with 6 to 128 edges per flank. Changing one changes all meshes.

/// Element edges along a flank, see flank_fractions.hpp.
struct FractionParams {
  int samples = 20000;  ///< of half a flank for integrals of 1/h: fine enough for the smallest core there is
  /// Growth of the size per length at which neighbours differ by a factor of e^0.35 = 1.4; cores are widened in steps
  /// of `widening` until it is kept. Larger: elements beside the flank get worse.
  double steepest = 0.35, widening = 1.1;
  /// Around the beginning of a rounding over the length w from the end: the contact ends 0.25 w to 0.55 w beyond it
  /// under a flank pressure of 80 MPa on titanium, R = 1 to 50 mm; half as much again for uneven loads. The pressure
  /// peaks in between and falls by a square root towards the edge of the contact. Parts of w.
  double zone_from = 0.3, zone_to = 1.1, core = 1.0 / 8;
  /// Edges in the middle of rounded flanks are at most so many times as long as equal ones: worn zones end there. So
  /// they are on sharp flanks of the usual grading.
  double longest = 2.4;
  int halvings = 10;  ///< that find the size of these: to a thousandth
};

/// Element sizes along the boundary.
struct SizeParams {
  int samples = 400;        ///< of an edge of the section, for integrals of 1/h
  int arc_parts = 16;       ///< chords of an arc, where walls are measured across it
  double parallel = 1e-12;  ///< sine of the angle to a wall below which it is never met
  double rounding = 1e-12;  ///< of a part between contact nodes: a point as close to one is that node
  double wall = 0.5;        ///< size at a wall, over its thickness: two elements through every wall
  double other_arcs = 2;    ///< sizes on arcs that are no fillets, over those on fillets
};

/// The filling with points. The shape of the triangles hardly depends on them.
struct FillingParams {
  double too_large = 1.25;       ///< circumradius against that of the equilateral triangle of the wanted size
  double clearance = 0.75;       ///< between points, in wanted sizes
  double wall_clearance = 0.55;  ///< from the boundary, in wanted sizes
  double crowded = 0.6;          ///< closer points are removed,
  double wall_crowded = 0.385;   ///< and closer ones to the boundary, in wanted sizes
  int rounds = 4, relaxations = 10;
  /// Last, interior points are moved wherever that raises the shape of the worst triangle around them, as long as it is
  /// below `good`: sweeps with steps of that many wanted sizes, shorter from sweep to sweep, in so many directions.
  double good = 0.75, step = 0.1;
  int sweeps = 8, directions = 8;
};

/// Poisson's ratio of the body by whose deformation a mesh is moved. Towards 1/2 elements keep their area and shear
/// more, towards 0 they keep their angles less well in narrow walls.
struct MotionParams {
  double poisson = 0.3;
};

static_assert(FractionParams{}.zone_from < FractionParams{}.zone_to, "a zone has an extent");
static_assert(FractionParams{}.core < FractionParams{}.zone_to - FractionParams{}.zone_from,
              "some edges within a zone");
static_assert(FillingParams{}.crowded < FillingParams{}.clearance, "what was just inserted is not removed");
static_assert(FillingParams{}.wall_crowded < FillingParams{}.wall_clearance, "nor at the boundary");
static_assert(FillingParams{}.clearance < FillingParams{}.too_large, "a large triangle has room for a point");
static_assert(MotionParams{}.poisson >= 0 && MotionParams{}.poisson < 0.5, "a body that can be compressed");

}  // namespace dovetail::geometry
