#pragma once

#include <vector>

#include "geometry/profile/parameters.hpp"

namespace dovetail::geometry {

/// Where the element edges along a flank meet, as fractions of its length: flank_elements + 1 of them from 0 to 1, the
/// same from both ends. The size of the edges at s follows h(s) ~ min_z (core_z + distance of s to zone z):
///
/// - at sharp ends the zones are the two ends and the core follows from flank_grading, the ratio of the sizes in the
///   middle and at the ends;
/// - with an edge radius they are the strips around the beginnings of the roundings in which the contact ends and the
///   pressure peaks, whose extent and core are fixed parts of the rounding's length (flank_form.hpp). No edge in the
///   middle is longer than 2.4 equal ones, whatever the grading.
///
/// Where edges are few the cores grow until neighbouring edges do not differ by more than a factor of about 1.4, so
/// that the elements stay good. Depends on the reference design only: all designs of a study share their fractions.
/// Where the flanks have different radii both have the zones of both.
[[nodiscard]] std::vector<double> flank_fractions(const ProfileParameters& reference, const MeshSizes& sizes);

/// The ends of the parts and their middles in turn.
[[nodiscard]] std::vector<double> with_middles(const std::vector<double>& ends);

/// The given ends (m + 1 of them) when they divide the flank into `parts` instead of m parts: at every m/parts-th one,
/// linear in between.
[[nodiscard]] std::vector<double> divided_like(const std::vector<double>& ends, int parts);

}  // namespace dovetail::geometry
