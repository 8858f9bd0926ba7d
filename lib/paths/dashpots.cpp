#include "paths/dashpots.hpp"

#include "dynamics/real_block.hpp"

namespace dovetail::paths {

std::shared_ptr<const dynamics::HarmonicSystem> Dashpots::system(double alpha) const {
  if (alpha == 0) return problem_.shared_system();
  auto damped = std::make_shared<dynamics::HarmonicSystem>(problem_.system());
  damped->of_model = false;
  for (int h = 1; h <= damped->stiffness.harmonics(); ++h)
    damped->stiffness.add_to_diagonal(h, std::complex<double>(0, alpha * h) * strength_);
  return damped;
}

// d f / d alpha = (I - D) (i h k U)
Eigen::MatrixXd Dashpots::slope(const steady::Point& point) const {
  Eigen::MatrixXd forces = Eigen::MatrixXd::Zero(point.displacement.rows(), point.displacement.cols());
  for (Eigen::Index h = 1; 2 * h < forces.cols(); ++h)
    dynamics::put_harmonic(std::complex<double>(0, static_cast<double>(h)) *
                               strength_.cwiseProduct(dynamics::harmonic_of(point.displacement, h)),
                           h, forces);
  return forces - steady::apply_force_derivative(point, forces);
}

branches::Branch Dashpots::follow(double alpha, const Eigen::MatrixXd& displacement,
                                  const branches::FollowOptions& steps) const {
  // The states on the way are forgotten: none keeps its factors.
  steady::Options options = problem_.options();
  options.linearise = false;
  const branches::Equations equations(
      options, [this](double s) { return std::make_shared<const steady::Problem>(problem_.at(system(s))); },
      [this](const steady::Point& point) { return slope(point); });
  steady::Point point;
  steady::evaluate(equations.at(alpha), displacement, point);
  steady::State start = steady::described(std::move(point), Status::converged, steady::AtSolution::linearise);
  start.iterations = start.evaluations = 1;
  return branches::follow(equations, std::move(start), {.from = alpha, .to = 0, .back = kInfinity}, steps);
}

}  // namespace dovetail::paths
