#pragma once

#include <Eigen/SparseCore>
#include <compare>
#include <cstdint>
#include <string>
#include <vector>

namespace dovetail::reduction {

/// A degree of freedom as finite-element codes name it: a direction, from 1, of a node.
struct NodeDirection {
  std::int64_t node = 0;
  int direction = 1;

  auto operator<=>(const NodeDirection&) const = default;  // NOLINT(modernize-use-nullptr): clang-tidy 14 errs
};

/// A structure as another code wrote it.
struct StructureMatrices {
  Eigen::SparseMatrix<double> stiffness, mass;  ///< [n, n], both triangles; without a file of the mass empty
  std::vector<NodeDirection> dofs;              ///< [n], ascending or in the order of the file of them
};

/// Reads a structure from text files that are told apart by what is in them:
/// - `node, direction, node, direction, value` in a line: Abaqus, *MATRIX OUTPUT, FORMAT=MATRIX INPUT or LABELS;
/// - `row column value` in a line, from 1: CalculiX's .sti and .mas, Abaqus's FORMAT=COORDINATE;
/// - Matrix Market;
/// - a linear *USER ELEMENT with *MATRIX blocks: *SUBSTRUCTURE MATRIX OUTPUT of either code.
/// The first and the last name their degrees of freedom; for the others `dofs` is a file with `node.direction` (or the
/// two apart) in a line for each row: CalculiX's .dof. Symmetric matrices list one triangle or both. Degrees of freedom
/// with a stiffness of 1e30 and more are held (Abaqus gives them 1e36) and left out.
/// `mass` may be empty: a quasi-static structure; of a *USER ELEMENT it is the file of both.
/// Throws InputError with file and line. Cost: a pass over the files and a sort of their entries.
[[nodiscard]] StructureMatrices read_structure(const std::string& stiffness, const std::string& mass,
                                               const std::string& dofs);

/// `node, direction, value` in a line, as *CLOAD has them; lines that begin with * are passed over. Throws InputError.
struct NodalForce {
  NodeDirection at;
  double value = 0;
  int line = 0;
};
[[nodiscard]] std::vector<NodalForce> read_nodal_forces(const std::string& path);

}  // namespace dovetail::reduction
