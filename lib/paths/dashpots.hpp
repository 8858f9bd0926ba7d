#pragma once

#include <Eigen/Core>
#include <memory>

#include "branches/follow.hpp"
#include "steady/point.hpp"

namespace dovetail::paths {

/// A problem with dashpots across the contact, Z_h + i h alpha k: strong ones leave little motion and an answer close
/// to closed contact; alpha = 0 is the problem itself. Damping takes the sharpness out of resonances, impacts and their
/// folds, so the way from strong to none exists where those over frequency or load break off.
class Dashpots {
 public:
  /// k = `strength` [nc], N/m, > 0. Refers to `problem`.
  Dashpots(const steady::Problem& problem, Eigen::VectorXd strength)
      : problem_(problem), strength_(std::move(strength)) {}

  [[nodiscard]] std::shared_ptr<const dynamics::HarmonicSystem> system(double alpha) const;

  /// Follows the branch f(U; alpha) = 0 from its point (`displacement`, alpha > 0) through its turns until alpha
  /// vanishes, in steps as `steps` says. The states on the way keep no tangents.
  [[nodiscard]] branches::Branch follow(double alpha, const Eigen::MatrixXd& displacement,
                                        const branches::FollowOptions& steps) const;

 private:
  [[nodiscard]] Eigen::MatrixXd slope(const steady::Point& point) const;

  const steady::Problem& problem_;
  Eigen::VectorXd strength_;
};

}  // namespace dovetail::paths
