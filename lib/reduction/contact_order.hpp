#pragma once

#include <Eigen/SparseCore>
#include <utility>
#include <vector>

#include "reduction/reduced_model.hpp"

namespace dovetail::reduction {

/// The contact nodes of a model whose first coordinates are the contact dofs, node by node (N, T1[, T2]).
[[nodiscard]] inline ContactNodes contact_first(ContactNodes nodes) {
  const Eigen::Index d = nodes.directions();
  for (Eigen::Index node = 0; node < nodes.count(); ++node) {
    nodes.normal(node) = static_cast<int>(d * node);
    for (Eigen::Index t = 0; t + 1 < d; ++t) nodes.tangential(node, t) = static_cast<int>(d * node + 1 + t);
  }
  if (nodes.slip_origin.size() == 0) nodes.slip_origin.setZero(nodes.count(), d - 1);
  return nodes;
}

/// A for every direction: the dofs of a node stand side by side.
[[nodiscard]] inline Eigen::SparseMatrix<double> for_directions(const Eigen::SparseMatrix<double>& average,
                                                                Eigen::Index directions) {
  std::vector<Eigen::Triplet<double>> entries;
  for (Eigen::Index column = 0; column < average.outerSize(); ++column)
    for (Eigen::SparseMatrix<double>::InnerIterator entry(average, column); entry; ++entry)
      for (Eigen::Index d = 0; d < directions; ++d)
        entries.emplace_back(static_cast<int>(directions * entry.row() + d),
                             static_cast<int>(directions * entry.col() + d), entry.value());
  Eigen::SparseMatrix<double> result(directions * average.rows(), directions * average.cols());
  result.setFromTriplets(entries.begin(), entries.end());
  return result;
}

}  // namespace dovetail::reduction
