#include "numerics/newton.hpp"

#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>

namespace dovetail::numerics {
namespace {

struct Search {
  Eigen::VectorXd x, residual;
  double norm = std::numeric_limits<double>::infinity();
  double fraction = 0;
  bool sufficient = false;
};

// Backtracks from the full step; the minimiser of the quadratic through |r|^2 at 0 (slope -2 |r|^2) and at t guides
// the next fraction. Keeps the best point in case none decreases enough.
Search backtrack(const NewtonSystem& system, const Eigen::VectorXd& x, const Eigen::VectorXd& step, double norm,
                 double reference, const NewtonParams& params, NewtonStats& stats) {
  Search best;
  for (double t = 1; t >= params.smallest_step;) {
    const Eigen::VectorXd candidate = x + t * step;
    Eigen::VectorXd residual = system.residual(candidate);
    ++stats.evaluations;
    const double trial = residual.norm();
    if (std::isfinite(trial) && trial < best.norm)
      best = {.x = candidate, .residual = std::move(residual), .norm = trial, .fraction = t, .sufficient = false};
    if (std::isfinite(trial) && trial <= (1 - params.decrease * t) * reference) {
      best.sufficient = true;
      return best;
    }
    const double ratio = std::isfinite(trial) ? (trial / norm) * (trial / norm) : 1e4;
    t *= std::clamp(t / (ratio - 1 + 2 * t), 0.1, 0.5);
  }
  return best;
}

}  // namespace

NewtonStats newton(const NewtonSystem& system, Eigen::VectorXd& x, const NewtonParams& params) {
  NewtonStats stats;
  Eigen::VectorXd residual = system.residual(x);
  ++stats.evaluations;
  double norm = residual.norm();
  Eigen::VectorXd best_x = x;
  double best_norm = norm;
  std::deque<double> recent{norm};
  int failed = 0;
  Eigen::VectorXd step;
  const auto finish = [&](Status status) {
    stats.status = status;
    stats.residual = best_norm;
    x = best_x;
    return stats;
  };
  const auto move_to = [&](Eigen::VectorXd to, double reached) {
    stats.reduction = reached / norm;
    x = std::move(to);
    norm = reached;
    recent.push_back(norm);
    if (static_cast<int>(recent.size()) > params.memory) recent.pop_front();
    if (norm < best_norm) {
      best_norm = norm;
      best_x = x;
    }
  };
  bool moved_away = false;  // the current point of the system is not x
  const auto chord = [&] {
    if (!system.chord_step || !system.chord_step(step) || !step.allFinite()) return false;
    moved_away = true;
    const Eigen::VectorXd candidate = x + step;
    const double reached = system.residual(candidate).norm();
    ++stats.evaluations;
    if (!(reached <= params.chord_ratio * norm)) return false;
    moved_away = false;
    move_to(candidate, reached);
    ++stats.chords;
    return true;
  };
  if (!std::isfinite(norm)) return finish(Status::not_finite);
  while (norm > params.tolerance) {
    if (!moved_away && chord()) {
      // Linear convergence stops just below the tolerance, where Newton's lands far below it: one more is cheap.
      if (norm <= params.tolerance) chord();
      continue;
    }
    if (stats.iterations >= params.max_iterations) return finish(Status::iteration_limit);
    if (moved_away) {
      // newton_step works on the last point evaluated.
      residual = system.residual(x);
      ++stats.evaluations;
      moved_away = false;
    }
    if (const Status solved = system.newton_step(step); solved != Status::converged) return finish(solved);
    ++stats.iterations;
    if (!step.allFinite()) return finish(Status::not_finite);
    const double reference = *std::max_element(recent.begin(), recent.end());
    Search found = backtrack(system, x, step, norm, reference, params, stats);
    if (!std::isfinite(found.norm)) return finish(Status::not_finite);
    if (!found.sufficient) {
      // At a kink the Newton direction of one side may not descend at all; a few such steps leave it behind.
      if (++failed > params.max_failed_searches) return finish(Status::stalled);
      recent.clear();
    }
    move_to(std::move(found.x), found.norm);
    moved_away = !found.sufficient;
  }
  return finish(Status::converged);
}

}  // namespace dovetail::numerics
