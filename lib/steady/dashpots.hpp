#pragma once

#include <Eigen/Core>
#include <functional>
#include <memory>

#include "steady/problem.hpp"

namespace dovetail::steady {

/// A problem with dashpots across the contact, Z_h + i h alpha k: strong ones leave little motion and an answer close
/// to closed contact; alpha = 0 is the problem itself. Damping takes the sharpness out of resonances, impacts and their
/// folds, so the way from strong to none exists where those over frequency or load break off.
class Dashpots {
 public:
  /// k = `strength` [nc], N/m, > 0. Refers to `problem`.
  Dashpots(const Problem& problem, Eigen::VectorXd strength) : problem_(problem), strength_(std::move(strength)) {}

  [[nodiscard]] std::shared_ptr<const dynamics::HarmonicSystem> system(double alpha) const;

  struct Followed {
    bool found = false;
    int jacobians = 0, evaluations = 0;
  };
  /// Follows the curve f(U; alpha) = 0 from its point (`displacement`, alpha > 0) through its turns until alpha
  /// vanishes, and there calls `arrive` with U [nc, 2H+1]; at most `max_jacobians` on the way.
  [[nodiscard]] Followed follow(double alpha, const Eigen::MatrixXd& displacement, int max_jacobians,
                                const std::function<bool(const Eigen::MatrixXd& displacement)>& arrive) const;

 private:
  const Problem& problem_;
  Eigen::VectorXd strength_;
};

}  // namespace dovetail::steady
