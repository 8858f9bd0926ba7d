#include "numerics/path.hpp"

#include <algorithm>
#include <cmath>

#include "numerics/dense_lu.hpp"

namespace dovetail::numerics {
namespace {

class Path {
 public:
  Path(const PathSystem& system, Eigen::VectorXd y, const PathParams& params)
      : system_(system), params_(params), y_(std::move(y)), n_(y_.size() - 1) {}

  PathStats follow() {
    tangent_ = Eigen::VectorXd::Unit(n_ + 1, n_);
    residual(y_);
    if (!turn()) return finish(Status::singular);
    double step = params_.first_step;
    for (int kinks = 0; stats_.jacobians < params_.max_jacobians;) {
      const double size = 1 + y_.norm();
      int corrections = 0;
      const Eigen::VectorXd next = correct(step, corrections);
      if (next.size() == 0) {
        step /= 3;
        if (step > params_.shortest_step * size) continue;
        constexpr int kMostKinks = 5;
        if (++kinks > kMostKinks) return finish(Status::stalled);
        step = 100 * params_.shortest_step * size;
        residual(y_ + step * tangent_);
        if (!turn()) return finish(Status::singular);
        continue;
      }
      if (next(n_) >= 1) {
        const double share = (1 - y_(n_)) / (next(n_) - y_(n_));
        if (system_.arrive(((1 - share) * y_ + share * next).head(n_))) return finish(Status::converged);
        step /= 4;
        if (step < params_.shortest_step * size) return finish(Status::stalled);
        continue;
      }
      y_ = next;
      kinks = 0;
      if (!turn()) return finish(Status::singular);
      constexpr int kFew = 3;
      if (corrections <= kFew) step = std::min(2 * step, params_.longest_step * (1 + y_.norm()));
    }
    return finish(Status::iteration_limit);
  }

 private:
  Eigen::VectorXd residual(const Eigen::VectorXd& y) {
    ++stats_.evaluations;
    return system_.residual(y);
  }

  DenseLu bordered(const Eigen::VectorXd& row) {
    ++stats_.jacobians;
    Eigen::MatrixXd matrix(n_ + 1, n_ + 1);
    matrix.topRows(n_) = system_.jacobian();
    matrix.bottomRows(1) = row.transpose();
    return DenseLu(std::move(matrix));
  }

  // The tangent at the current point of the system, oriented.
  bool turn() {
    DenseLu lu = bordered(tangent_);
    // A path may go on at a right angle.
    if (lu.status() != Status::converged) lu = bordered(Eigen::VectorXd::Unit(n_ + 1, n_));
    if (lu.status() != Status::converged) return false;
    const Eigen::VectorXd along = lu.solve(Eigen::VectorXd::Unit(n_ + 1, n_)).col(0);
    if (!along.allFinite()) return false;
    // Whatever the row r of the bordered matrix: r.along = 1 > 0, so det [A; along] has the sign of det [A; r].
    const int sign = lu.determinant_sign();
    if (orientation_ == 0) orientation_ = sign;
    tangent_ = (sign == orientation_ ? 1 : -1) * along.normalized();
    return true;
  }

  // Newton in the plane at `step` along the tangent; empty when it does not converge, or to a point far away.
  Eigen::VectorXd correct(double step, int& corrections) {
    constexpr int kMost = 6;
    constexpr double kContraction = 0.8, kNear = 1e-7, kFar = 3;
    Eigen::VectorXd z = y_ + step * tangent_;
    double before = 0;
    for (corrections = 0; corrections < kMost; ++corrections) {
      const Eigen::VectorXd r = residual(z);
      const double norm = r.norm();
      if (!std::isfinite(norm)) return {};
      if (norm <= params_.tolerance) return (z - y_).norm() < kFar * step ? z : Eigen::VectorXd();
      if (corrections > 1 && norm > kContraction * before && norm > kNear) return {};
      before = norm;
      const DenseLu lu = bordered(tangent_);
      if (lu.status() != Status::converged) return {};
      Eigen::VectorXd right(n_ + 1);
      right << -r, step - tangent_.dot(z - y_);
      z += lu.solve(right).col(0);
    }
    return {};
  }

  PathStats finish(Status status) {
    stats_.status = status;
    return stats_;
  }

  const PathSystem& system_;
  const PathParams& params_;
  Eigen::VectorXd y_, tangent_;
  Eigen::Index n_;
  int orientation_ = 0;
  PathStats stats_;
};

}  // namespace

PathStats follow_path(const PathSystem& system, Eigen::VectorXd y, const PathParams& params) {
  return Path(system, std::move(y), params).follow();
}

}  // namespace dovetail::numerics
