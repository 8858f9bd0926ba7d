#pragma once

#include <Eigen/SparseCore>
#include <vector>

namespace dovetail::geometry {

/// Weights of the linear (one contact line) or bilinear interpolation between contact nodes on a grid. Contact node
/// (i, j) is at (across[i], along[j]) and has the number i + (across nodes) j; point (k, l) is at
/// (points_across[k], points_along[l]) and has the row k + (points across) l. Both lists of contact nodes rise
/// strictly; one of a single node carries every point; points lie between the first and the last node (up to
/// rounding). Entries >= 0, rows sum to 1; a point at a contact node follows that node alone.
[[nodiscard]] Eigen::SparseMatrix<double> bilinear_interpolation(const std::vector<double>& across,
                                                                 const std::vector<double>& along,
                                                                 const std::vector<double>& points_across,
                                                                 const std::vector<double>& points_along);

/// `parts` equal parts of 0 ... 1: their ends.
[[nodiscard]] std::vector<double> equal_fractions(int parts);

}  // namespace dovetail::geometry
