#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

namespace dovetail::reduction {

/// Reads a real matrix in the Matrix Market exchange format: `coordinate` or `array`, `real` or `integer`, `general` or
/// `symmetric` (one triangle, either one; both are filled). Indices count from 1, comments start with %, entries that
/// are not listed are zero. Strict: throws InputError naming file and line for anything else - a pair listed twice, an
/// index outside the size, missing or surplus entries, a number that is not finite, complex or pattern matrices.
/// Cost: one pass over the file; the result is dense, at most 20000 rows and columns.
[[nodiscard]] Eigen::MatrixXd read_matrix_market(const std::string& path);

/// The entries that a file lists, of a symmetric one those of one triangle: what is too large to be dense.
struct MatrixEntries {
  struct Entry {
    std::int64_t row, column;  ///< from 0
    double value;
    int line;  ///< of the file
  };
  std::int64_t rows = 0, columns = 0;
  std::vector<Entry> entries;
};

/// The same of a matrix of any size, but for pairs listed twice. `text`: of the file at `path`.
[[nodiscard]] MatrixEntries read_matrix_market_entries(const std::string& path, const std::string& text);

/// Writes `matrix` as `coordinate real`, `symmetric` (lower triangle) when it is that to the last bit, else `general`;
/// read_matrix_market returns it to the last bit. The file at `path` is replaced in one step. `comment`: one line.
void write_matrix_market(const std::string& path, const Eigen::MatrixXd& matrix, const std::string& comment);

}  // namespace dovetail::reduction
