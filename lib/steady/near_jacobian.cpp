#include "steady/near_jacobian.hpp"

#include <algorithm>
#include <cassert>
#include <utility>
#include <vector>

#include "steady/params.hpp"

namespace dovetail::steady {
namespace {

/// (D - D_P) (eps I - Z) in the rows of the nodes where D differs.
class Difference {
 public:
  Difference(const Point& point, const Point& near) : system_(point.problem->system().stiffness) {
    const Eigen::Index d = point.problem->model().directions();
    for (std::size_t i = 0; i < point.nodes.size(); ++i) {
      Eigen::MatrixXd difference = point.nodes[i].force_derivative - near.nodes[i].force_derivative;
      if (difference.cwiseAbs().maxCoeff() <= SingularityParams{}.same) continue;
      differences_.push_back(std::move(difference));
      for (Eigen::Index r = 0; r < d; ++r) dofs_.push_back(static_cast<Eigen::Index>(i) * d + r);
    }
    blocks_ = {.stiffness = &system_, .derivative = {}, .penalty = point.problem->dof_penalty()(dofs_)};
    for (const Eigen::MatrixXd& difference : differences_) blocks_.derivative.push_back(&difference);
  }

  [[nodiscard]] Eigen::VectorXd apply(const Eigen::VectorXd& x) const {
    const auto rows = static_cast<Eigen::Index>(dofs_.size()), k = blocks_.coefficients();
    const Eigen::MatrixXd there = x.reshaped(system_.size(), k)(dofs_, Eigen::all);
    Eigen::VectorXd moved = (blocks_.penalty.asDiagonal() * there).reshaped() - system_.apply_at(dofs_, x);
    if (rows == 0) return moved;
    return apply_derivative(blocks_, moved, false);
  }
  /// The vector over all unknowns that is this one in the rows, and zero elsewhere.
  [[nodiscard]] Eigen::VectorXd among_all(const Eigen::VectorXd& rows) const {
    const Eigen::Index k = blocks_.coefficients();
    Eigen::MatrixXd all = Eigen::MatrixXd::Zero(system_.size(), k);
    all(dofs_, Eigen::all) = rows.reshaped(rows.size() / k, k);
    return all.reshaped();
  }

 private:
  const dynamics::HarmonicMatrices& system_;
  std::vector<Eigen::MatrixXd> differences_;
  std::vector<Eigen::Index> dofs_;
  JacobianBlocks blocks_;
};

numerics::GmresResult of_one_stiffness(const Point& point, const FactoredJacobian& near, const Eigen::VectorXd& rhs,
                                       numerics::GmresOptions options) {
  numerics::GmresResult result;
  const double length = rhs.norm();
  if (options.most == 0 || !(length > 0) || !rhs.allFinite())
    return numerics::gmres({}, rhs, {.tolerance = options.tolerance, .most = 0});
  const Difference difference(point, near.point());
  const Eigen::VectorXd first = near.solve(rhs), image = difference.apply(first);
  if (!first.allFinite() || !image.allFinite()) {
    result.status = Status::not_finite;
    return result;
  }
  const double left = image.norm() / length;
  options.most -= 1;
  if (left > 0) options.tolerance /= left;
  if (left == 0 || options.tolerance >= 1)
    result.status = Status::converged;
  else
    result = numerics::gmres(
        {.near_solve = [&](const Eigen::VectorXd& b) -> Eigen::VectorXd { return near.solve(difference.among_all(b)); },
         .apply = [&](const Eigen::VectorXd& x, const Eigen::VectorXd& b) -> Eigen::VectorXd {
           return b + difference.apply(x);
         }},
        -image, options);
  if (result.status == Status::not_finite) return result;
  if (result.x.size() != first.size()) result.x = Eigen::VectorXd::Zero(first.size());
  result.x += first;
  result.products += 1;
  result.residual *= left;
  // J P^-1 b = b + the difference.
  result.least_stretch = std::min(result.least_stretch, (rhs + difference.among_all(image)).norm() / length);
  return result;
}

}  // namespace

numerics::GmresResult solve_near(const Point& point, const FactoredJacobian& near, const Eigen::VectorXd& rhs,
                                 const numerics::GmresOptions& options) {
  assert(near.serve(*point.problem));
  if (point.problem->shared_system() == near.point().problem->shared_system())
    return of_one_stiffness(point, near, rhs, options);
  const JacobianBlocks here = blocks(point);
  return numerics::gmres({.near_solve = [&near](const Eigen::VectorXd& b) -> Eigen::VectorXd { return near.solve(b); },
                          .apply = [&here](const Eigen::VectorXd& x, const Eigen::VectorXd&) -> Eigen::VectorXd {
                            return apply_jacobian(here, x);
                          }},
                         rhs, options);
}

}  // namespace dovetail::steady
