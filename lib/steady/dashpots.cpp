#include "steady/dashpots.hpp"

#include <cmath>

#include "dynamics/real_block.hpp"
#include "numerics/path.hpp"
#include "steady/point.hpp"

namespace dovetail::steady {

std::shared_ptr<const dynamics::HarmonicSystem> Dashpots::system(double alpha) const {
  if (alpha == 0) return problem_.shared_system();
  auto damped = std::make_shared<dynamics::HarmonicSystem>(problem_.system());
  for (std::size_t h = 1; h < damped->harmonics.size(); ++h)
    damped->harmonics[h].stiffness.diagonal() += std::complex<double>(0, alpha * static_cast<double>(h)) * strength_;
  return damped;
}

Dashpots::Followed Dashpots::follow(double alpha, const Eigen::MatrixXd& displacement, int max_jacobians,
                                    const std::function<bool(const Eigen::MatrixXd& displacement)>& arrive) const {
  const Eigen::Index rows = displacement.rows(), columns = displacement.cols(), n = displacement.size();
  const double force = problem_.system().force_scale;
  // Unknowns and residuals are forces, both relative to the excitation; alpha falls as 1 - s.
  const Eigen::VectorXd unit = (force * strength_.cwiseInverse()).replicate(columns, 1);
  Point point;
  const auto shaped = [&](const Eigen::VectorXd& x) {
    const Eigen::VectorXd u = unit.cwiseProduct(x);
    return Eigen::MatrixXd(u.reshaped(rows, columns));
  };
  const auto residual = [&](const Eigen::VectorXd& y) {
    evaluate(std::make_shared<const Problem>(problem_.at(system(alpha * (1 - y(n))))), shaped(y.head(n)), point);
    return Eigen::VectorXd(point.residual.reshaped() / force);
  };
  const auto jacobian_of = [&] {
    Eigen::MatrixXd matrix(n, n + 1);
    // What is not finite ends the path.
    if (spent(problem_.budget()) || point.status == Status::not_finite) return matrix.setConstant(std::nan("")).eval();
    differentiate(point);
    // d f / d s = -alpha (I - D) (i h k U)
    Eigen::MatrixXd slope = Eigen::MatrixXd::Zero(rows, columns);
    for (Eigen::Index h = 1; 2 * h < columns; ++h)
      dynamics::put_harmonic(std::complex<double>(0, -alpha * static_cast<double>(h)) *
                                 strength_.cwiseProduct(dynamics::harmonic_of(point.displacement, h)),
                             h, slope);
    const Eigen::MatrixXd column = slope - apply_force_derivative(point, slope);
    matrix.leftCols(n) = jacobian(point) * (unit / force).asDiagonal();
    matrix.col(n) = column.reshaped() / force;
    return matrix;
  };
  Eigen::VectorXd start(n + 1);
  start << displacement.reshaped().cwiseQuotient(unit), 0;
  const numerics::PathStats stats =
      numerics::follow_path({.residual = residual,
                             .jacobian = jacobian_of,
                             .arrive = [&](const Eigen::VectorXd& x) { return arrive(shaped(x)); }},
                            start, {.tolerance = problem_.options().tolerance, .max_jacobians = max_jacobians});
  return {.found = stats.status == Status::converged, .jacobians = stats.jacobians, .evaluations = stats.evaluations};
}

}  // namespace dovetail::steady
