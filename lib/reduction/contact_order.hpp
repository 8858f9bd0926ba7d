#pragma once

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

}  // namespace dovetail::reduction
