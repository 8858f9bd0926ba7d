#include "response/dashpots.hpp"

#include <cmath>
#include <optional>

#include "numerics/path.hpp"
#include "response/real_block.hpp"

namespace dovetail::response {

Dashpots::Dashpots(std::shared_ptr<const HarmonicSystem> system, Eigen::VectorXd strength,
                   std::function<SteadyResidual(const std::shared_ptr<const HarmonicSystem>&)> problem)
    : system_(std::move(system)), strength_(std::move(strength)), problem_(std::move(problem)) {}

std::shared_ptr<const HarmonicSystem> Dashpots::system(double alpha) const {
  if (alpha == 0) return system_;
  auto damped = std::make_shared<HarmonicSystem>(*system_);
  for (std::size_t h = 1; h < damped->harmonics.size(); ++h)
    damped->harmonics[h].stiffness.diagonal() += std::complex<double>(0, alpha * static_cast<double>(h)) * strength_;
  return damped;
}

Dashpots::Followed Dashpots::follow(double alpha, const Eigen::MatrixXd& displacement, double tolerance,
                                    int max_jacobians,
                                    const std::function<bool(const Eigen::MatrixXd& displacement)>& arrive) const {
  const Eigen::Index rows = displacement.rows(), columns = displacement.cols(), n = displacement.size();
  const double force = system_->force_scale;
  // Unknowns and residuals are forces, both relative to the excitation; alpha falls as 1 - s.
  const Eigen::VectorXd unit = (force * strength_.cwiseInverse()).replicate(columns, 1);
  std::optional<SteadyResidual> residual;
  ResidualState state;
  const auto shaped = [&](const Eigen::VectorXd& x) {
    const Eigen::VectorXd u = unit.cwiseProduct(x);
    return Eigen::MatrixXd(u.reshaped(rows, columns));
  };
  const numerics::PathSystem path{.residual =
                                      [&](const Eigen::VectorXd& y) {
                                        residual.emplace(problem_(system(alpha * (1 - y(n)))));
                                        residual->evaluate(shaped(y.head(n)), true, state);
                                        return Eigen::VectorXd(state.residual.reshaped() / force);
                                      },
                                  .jacobian =
                                      [&] {
                                        // What is not finite ends the path.
                                        if (spent(residual->budget()))
                                          return Eigen::MatrixXd(Eigen::MatrixXd::Constant(n, n + 1, std::nan("")));
                                        // d f / d s = -alpha (I - D) (i h k U)
                                        Eigen::MatrixXd slope = Eigen::MatrixXd::Zero(rows, columns);
                                        for (Eigen::Index h = 1; 2 * h < columns; ++h)
                                          put_harmonic(std::complex<double>(0, -alpha * static_cast<double>(h)) *
                                                           strength_.cwiseProduct(harmonic_of(state.displacement, h)),
                                                       h, slope);
                                        const Eigen::MatrixXd column =
                                            slope - residual->apply_force_derivative(state, slope);
                                        Eigen::MatrixXd matrix(n, n + 1);
                                        matrix.leftCols(n) = residual->jacobian(state) * (unit / force).asDiagonal();
                                        matrix.col(n) = column.reshaped() / force;
                                        return matrix;
                                      },
                                  .arrive = [&](const Eigen::VectorXd& x) { return arrive(shaped(x)); }};
  Eigen::VectorXd start(n + 1);
  start << displacement.reshaped().cwiseQuotient(unit), 0;
  const numerics::PathStats stats =
      numerics::follow_path(path, start, {.tolerance = tolerance, .max_jacobians = max_jacobians});
  return {.found = stats.status == Status::converged, .jacobians = stats.jacobians, .evaluations = stats.evaluations};
}

}  // namespace dovetail::response
