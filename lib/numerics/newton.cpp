#include "numerics/newton.hpp"

#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>
#include <utility>

namespace dovetail::numerics {
namespace {

struct Search {
  Eigen::VectorXd x;
  double norm = std::numeric_limits<double>::infinity();
  bool sufficient = false;
};

class Newton {
 public:
  Newton(const NewtonSystem& system, const Eigen::VectorXd& start, const NewtonParams& params)
      : system_(system), params_(params), x_(start), best_x_(start) {
    norm_ = best_norm_ = residual_norm(x_);
    recent_.push_back(norm_);
  }

  NewtonStats run(Eigen::VectorXd& x) {
    stats_.status = std::isfinite(norm_) ? iterate() : Status::not_finite;
    stats_.residual = best_norm_;
    x = best_x_;
    return stats_;
  }

 private:
  Status iterate() {
    while (norm_ > params_.tolerance) {
      if (!moved_away_ && chord()) {
        // Linear convergence stops just below the tolerance, where Newton's lands far below it: one more is cheap.
        if (norm_ <= params_.tolerance) chord();
        continue;
      }
      if (stats_.iterations >= params_.max_iterations) return Status::iteration_limit;
      // newton_step works on the last point evaluated.
      if (std::exchange(moved_away_, false)) residual_norm(x_);
      if (const Status solved = full_step(); solved != Status::converged) return solved;
    }
    return Status::converged;
  }

  Status full_step() {
    if (const Status solved = system_.newton_step(step_); solved != Status::converged) return solved;
    ++stats_.iterations;
    if (!step_.allFinite()) return Status::not_finite;
    const double reference = *std::max_element(recent_.begin(), recent_.end());
    Search found = backtrack(reference);
    if (!std::isfinite(found.norm)) return Status::not_finite;
    if (!found.sufficient) {
      // At a kink the Newton direction of one side may not descend at all; a few such steps leave it behind.
      if (++failed_ > params_.max_failed_searches) return Status::stalled;
      recent_.clear();
    }
    move_to(std::move(found.x), found.norm);
    moved_away_ = !found.sufficient;
    return Status::converged;
  }

  // Backtracks from the full step; the minimiser of the quadratic through |r|^2 at 0 (slope -2 |r|^2) and at t guides
  // the next fraction. Keeps the best point in case none decreases enough below the reference.
  Search backtrack(double reference) {
    Search best;
    for (double t = 1; t >= params_.smallest_step;) {
      const Eigen::VectorXd candidate = x_ + t * step_;
      const double trial = residual_norm(candidate);
      if (std::isfinite(trial) && trial < best.norm) best = {.x = candidate, .norm = trial, .sufficient = false};
      if (std::isfinite(trial) && trial <= (1 - params_.decrease * t) * reference) {
        best.sufficient = true;
        return best;
      }
      const double ratio =
          std::isfinite(trial) ? (trial / norm_) * (trial / norm_) : std::numeric_limits<double>::infinity();
      t *= std::clamp(t / (ratio - 1 + 2 * t), params_.shortest_cut, params_.longest_cut);
    }
    return best;
  }

  bool chord() {
    if (!system_.chord_step || !system_.chord_step(step_) || !step_.allFinite()) return false;
    moved_away_ = true;
    Eigen::VectorXd candidate = x_ + step_;
    const double reached = residual_norm(candidate);
    if (!(reached <= params_.chord_ratio * norm_)) return false;
    moved_away_ = false;
    move_to(std::move(candidate), reached);
    ++stats_.chords;
    return true;
  }

  void move_to(Eigen::VectorXd to, double reached) {
    stats_.reduction = reached / norm_;
    x_ = std::move(to);
    norm_ = reached;
    recent_.push_back(norm_);
    if (static_cast<int>(recent_.size()) > params_.memory) recent_.pop_front();
    if (norm_ < best_norm_) {
      best_norm_ = norm_;
      best_x_ = x_;
    }
  }

  double residual_norm(const Eigen::VectorXd& x) {
    ++stats_.evaluations;
    return system_.residual(x).norm();
  }

  const NewtonSystem& system_;
  const NewtonParams& params_;
  NewtonStats stats_;
  Eigen::VectorXd x_, best_x_, step_;
  double norm_ = 0, best_norm_ = 0;
  std::deque<double> recent_;
  int failed_ = 0;
  bool moved_away_ = false;  // the current point of the system is not x_
};

}  // namespace

NewtonStats newton(const NewtonSystem& system, Eigen::VectorXd& x, const NewtonParams& params) {
  return Newton(system, x, params).run(x);
}

}  // namespace dovetail::numerics
