#pragma once

#include "optimizer/scene/scene.hpp"
#include "reduction/reduced_model.hpp"
#include "reduction/rough_interface.hpp"

namespace dovetail::optimizer {

/// Of rough flanks.
[[nodiscard]] inline reduction::InterfaceStiffness interface_of(const ContactProperties& contact) {
  return {.normal = contact.normal_stiffness, .tangential = contact.tangential_stiffness};
}

/// Contact nodes on the trace of a mesh or between those; contact dofs begin at `first`.
/// - `surface`: fem::ContactSurface or fem::ContactCells
template <class Surface>
[[nodiscard]] reduction::ContactNodes contact_nodes(const Surface& surface, Eigen::Index first,
                                                    const ContactProperties& properties) {
  const Eigen::Index count = surface.count(), directions = surface.position.rows();
  reduction::ContactNodes nodes;
  nodes.normal.resize(count);
  nodes.tangential.resize(count, directions - 1);
  for (Eigen::Index i = 0; i < count; ++i) {
    nodes.normal(i) = static_cast<int>(first + directions * i);
    for (Eigen::Index t = 0; t + 1 < directions; ++t)
      nodes.tangential(i, t) = nodes.normal(i) + static_cast<int>(t) + 1;
  }
  nodes.area = surface.area;
  nodes.gap = surface.gap;
  nodes.friction = Eigen::VectorXd::Constant(count, properties.friction);
  nodes.wear_law = properties.wear_law;
  const contact::WearNumbers& wear = properties.wear.at(properties.wear_law);
  nodes.wear_coefficient = Eigen::VectorXd::Constant(count, wear.coefficient);
  if (contact::find_wear_law(properties.wear_law)->parameter(&contact::WearNumbers::threshold))
    nodes.wear_threshold = Eigen::VectorXd::Constant(count, wear.threshold);
  nodes.position = Eigen::MatrixX3d::Zero(count, 3);
  nodes.position.leftCols(directions) = surface.position.transpose();
  nodes.group = surface.flank;
  nodes.slip_origin = Eigen::MatrixXd::Zero(count, directions - 1);
  return nodes;
}

}  // namespace dovetail::optimizer
