#pragma once

#include <Eigen/Core>
#include <functional>
#include <memory>

#include "response/residual.hpp"

namespace dovetail::response {

/// A problem with dashpots across the contact, Z_h + i h alpha k: strong ones leave little motion and an answer close
/// to closed contact; alpha = 0 is the problem itself. Damping takes the sharpness out of resonances, impacts and their
/// folds, so the way from strong to none exists where those over frequency or load break off.
class Dashpots {
 public:
  /// k = `strength` [nc], N/m, > 0; `problem(system)` sets up the residual for a system.
  Dashpots(std::shared_ptr<const HarmonicSystem> system, Eigen::VectorXd strength,
           std::function<SteadyResidual(const std::shared_ptr<const HarmonicSystem>&)> problem);

  [[nodiscard]] std::shared_ptr<const HarmonicSystem> system(double alpha) const;

  struct Followed {
    bool found = false;
    int jacobians = 0, evaluations = 0;
  };
  /// Follows the curve f(U; alpha) = 0 from its point (`displacement`, alpha > 0) through its turns until alpha
  /// vanishes, and there calls `arrive` with U [nc, 2H+1]; at most `max_jacobians` on the way.
  [[nodiscard]] Followed follow(double alpha, const Eigen::MatrixXd& displacement, double tolerance, int max_jacobians,
                                const std::function<bool(const Eigen::MatrixXd& displacement)>& arrive) const;

 private:
  std::shared_ptr<const HarmonicSystem> system_;
  Eigen::VectorXd strength_;
  std::function<SteadyResidual(const std::shared_ptr<const HarmonicSystem>&)> problem_;
};

}  // namespace dovetail::response
