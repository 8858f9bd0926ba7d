#include "contact/pseudo_penalty.hpp"

#include <cassert>

#include "contact/params.hpp"

namespace dovetail::contact {

Eigen::VectorXd PseudoPenalty::by_dof(Eigen::Index directions) const {
  Eigen::VectorXd result(normal.size() * directions);
  for (Eigen::Index i = 0; i < normal.size(); ++i) {
    result(i * directions) = normal(i);
    result.segment(i * directions + 1, directions - 1).setConstant(tangential(i));
  }
  return result;
}

PseudoPenalty pseudo_penalty(const Eigen::VectorXd& local_stiffness, Eigen::Index directions, double normal,
                             double tangential) {
  assert(directions >= 2 && local_stiffness.size() % directions == 0);
  const Eigen::Index nodes = local_stiffness.size() / directions;
  const double largest = nodes > 0 ? local_stiffness.maxCoeff() : 0;
  constexpr PenaltyParams kParams;
  const auto automatic = [&](double stiffness) {
    if (stiffness > kParams.no_stiffness * largest && stiffness > 0) return stiffness;
    // Contact that has mass resists the faster it is moved, without limit: a stiff value in proportion to that.
    if (stiffness < 0) return -kParams.of_mass * stiffness;
    return largest > 0 ? kParams.least_stiffness * largest : 1.0;
  };
  PseudoPenalty result{.normal = Eigen::VectorXd(nodes), .tangential = Eigen::VectorXd(nodes)};
  for (Eigen::Index i = 0; i < nodes; ++i) {
    const double along = local_stiffness(i * directions);
    const double across = local_stiffness.segment(i * directions + 1, directions - 1).mean();
    result.normal(i) = normal > 0 ? normal : automatic(along);
    result.tangential(i) = tangential > 0 ? tangential : automatic(across);
  }
  return result;
}

}  // namespace dovetail::contact
