#pragma once

#include <Eigen/Core>

#include "reduction/recovery.hpp"
#include "reduction/reduced_model.hpp"

namespace dovetail::reduction {

/// Stiffness of rough flanks per area, in series with whatever law holds where they touch; 0: rigid.
struct InterfaceStiffness {
  double normal = 0, tangential = 0;  ///< N/m^3, both flanks together

  [[nodiscard]] bool rigid() const { return normal == 0 && tangential == 0; }
};

/// Flexibility of the springs at contact dofs, node by node (N, T1[, T2]), of nodes with these areas [Nc], m^2: [Nc
/// directions] m/N, 0 where they are rigid.
[[nodiscard]] Eigen::VectorXd spring_flexibility(const InterfaceStiffness& stiffness, const Eigen::VectorXd& area,
                                                 Eigen::Index directions);

/// The model with springs between its contact dofs and new ones without mass, at which the contact now acts; the old
/// ones become internal coordinates. Exact for any contact law: lambda is the force of the spring. A direction that
/// stays rigid keeps its dofs. New dofs are appended, and `recovery`, if any, goes on reading the old ones.
void add_interface(const InterfaceStiffness& stiffness, ReducedModel& model, Recovery* recovery = nullptr);

}  // namespace dovetail::reduction
