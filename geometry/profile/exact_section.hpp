#pragma once

#include "geometry/profile/params.hpp"
#include "geometry/profile/profile.hpp"

namespace dovetail::geometry {

// The exact questions about chains of lines and arcs, answered with exact arithmetic on exact arcs (CGAL).
//
// Resolution: the tangent points of the design are irrational, so every arc is replaced by the exact circle
// through its start, middle and end rounded to picometres (ExactParams::snap). Two curves that touch in the design may
// therefore cross by about a picometre near their touching point; overlaps are told from that by their area,
// see ExactParams::noise.

/// True when no two edges meet except where one ends and the next one starts. Cost: O(n log n), under a
/// millisecond for a section.
[[nodiscard]] bool is_simple(const Chain& chain);

/// Area common to the insides of two closed, simple, counter-clockwise chains, m2. Common boundary (the flanks)
/// has no area. Neither chain may cross itself or run clockwise: callers check (CGAL does not in Release). Cost: some
/// milliseconds.
[[nodiscard]] double overlap_area(const Chain& first, const Chain& second);

}  // namespace dovetail::geometry
