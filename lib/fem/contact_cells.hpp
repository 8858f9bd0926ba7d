#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <vector>

#include "fem/sector_mesh.hpp"

namespace dovetail::fem {

/// How a flank is divided into contact cells: strips along the slot (one in the plane), each of them divided across
/// the slot on its own. Ends as fractions of the flank, rising from 0 to 1.
struct FlankCells {
  std::vector<double> along;                ///< [strips + 1]
  std::vector<std::vector<double>> across;  ///< [strips][cells + 1], neck to root side
  bool operator==(const FlankCells& other) const = default;
};

/// Cells that lie side by side across the slot.
struct CellStrip {
  std::size_t flank = 0;     ///< index of its flank
  std::size_t first = 0;     ///< its first cell, neck side
  std::vector<double> ends;  ///< [cells + 1] of the flank, rising from 0 to 1

  [[nodiscard]] std::size_t count() const { return ends.size() - 1; }
  [[nodiscard]] double length(std::size_t k) const { return ends[k + 1] - ends[k]; }  ///< of the flank
  [[nodiscard]] double middle(std::size_t k) const { return (ends[k] + ends[k + 1]) / 2; }
};

/// Contact nodes that are cells of the flanks. A cell presses with a uniform pressure, and its relative displacement is
/// the mean over the cell of the trace's:
///
///   u_k = 1/|c_k| integral_{c_k} v ds = (average v)_k,   forces on the trace: average^T lambda,
///
/// so that what a cell does on the mesh is continuous in where its ends are. Cells should not be smaller than the
/// trace resolves, about half an edge; narrower ones act like points.
struct ContactCells {
  std::vector<FlankCells> flanks;
  Eigen::SparseMatrix<double> average;  ///< [cells, trace nodes], rows sum to 1
  Eigen::VectorXd area;                 ///< [cells] m^2
  Eigen::MatrixXd position;             ///< [d, cells] m, middles
  Eigen::VectorXd gap;                  ///< [cells] m, mean initial gap
  Eigen::VectorXi flank;                ///< [cells] index into `flanks`
  Eigen::VectorXi strip;                ///< [cells] number of the strip over all flanks

  [[nodiscard]] Eigen::Index count() const { return area.size(); }
  /// All strips in the order of the cells.
  [[nodiscard]] std::vector<CellStrip> strips() const;
};

/// Cells in the order flank, strip, neck to root side. `trace`: from with_trace. Throws InputError when ends do not
/// rise from 0 to 1.
[[nodiscard]] ContactCells contact_cells(const SectorMesh& trace, const std::vector<FlankCells>& flanks);

}  // namespace dovetail::fem
