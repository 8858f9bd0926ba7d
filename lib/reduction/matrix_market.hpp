#pragma once

#include <Eigen/Core>
#include <string>

namespace dovetail::reduction {

/// Reads a real matrix in the Matrix Market exchange format: `coordinate` or `array`, `real` or `integer`, `general` or
/// `symmetric` (one triangle, either one; both are filled). Indices count from 1, comments start with %, entries that
/// are not listed are zero. Strict: throws InputError naming file and line for anything else - a pair listed twice, an
/// index outside the size, missing or surplus entries, a number that is not finite, complex or pattern matrices.
/// Cost: one pass over the file; the result is dense, at most 20000 rows and columns.
[[nodiscard]] Eigen::MatrixXd read_matrix_market(const std::string& path);

/// Writes `matrix` as `coordinate real`, `symmetric` (lower triangle) when it is that to the last bit, else `general`;
/// read_matrix_market returns it to the last bit. The file at `path` is replaced in one step. `comment`: one line.
void write_matrix_market(const std::string& path, const Eigen::MatrixXd& matrix, const std::string& comment);

}  // namespace dovetail::reduction
