#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "reduction/structure_matrices.hpp"

namespace dovetail::reduction {

/// A superelement as *SUBSTRUCTURE MATRIX OUTPUT of Abaqus and CalculiX writes it: a linear *USER ELEMENT, its nodes in
/// a comment, the directions of its nodes, and *MATRIX blocks with the lower triangle row by row.
struct UserElement {
  std::vector<NodeDirection> dofs;  ///< [n]
  Eigen::MatrixXd stiffness, mass;  ///< [n, n], or empty: the file has none
};

/// Whether the text of a file is one.
[[nodiscard]] bool is_user_element(const std::string& text);

/// `text`: of the file at `path`. Throws InputError with file and line.
[[nodiscard]] UserElement read_user_element(const std::string& path, const std::string& text);

}  // namespace dovetail::reduction
