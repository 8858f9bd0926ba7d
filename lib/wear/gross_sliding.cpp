#include "wear/gross_sliding.hpp"

#include <Eigen/Cholesky>

#include "wear/archard.hpp"
#include "wear/steady_rate.hpp"

namespace dovetail::wear {

namespace {

double loaded_area(const response::CondensedModel& model, const response::SteadyState& state) {
  double area = 0.0;
  for (Eigen::Index i = 0; i < model.nodes(); ++i)
    if (state.nodes[static_cast<std::size_t>(i)].carries_load) area += model.contact().area[i];
  return area;
}

bool held_without_contact(const response::CondensedModel& model, double omega) {
  Eigen::MatrixXd stiffness = model.harmonic(0, omega).stiffness.real();
  // What rounding leaves of a direction without stiffness is less.
  constexpr double kNothing = 1e-9;
  stiffness.diagonal().array() -= kNothing * stiffness.diagonal().cwiseAbs().maxCoeff();
  return Eigen::LLT<Eigen::MatrixXd>(stiffness).info() == Eigen::Success;
}

}  // namespace

bool Bearing::impossible() const {
  return needed && penetrations > kLevelDepth;
}

Bearing bearing(const response::CondensedModel& model, const response::SteadyState& unworn,
                const response::SteadyState& worn, const Eigen::VectorXd& depth) {
  Bearing left;
  if (depth.size() == 0) return left;
  left.needed = !held_without_contact(model, unworn.omega);
  if (const double before = loaded_area(model, unworn); before > 0.0) left.share = loaded_area(model, worn) / before;
  if (const double penetration = largest_penetration(model, unworn); penetration > 0.0)
    left.penetrations = depth.maxCoeff() / penetration;
  return left;
}

}  // namespace dovetail::wear
