#include "branches/bordered.hpp"

#include <cmath>

#include "branches/params.hpp"

namespace dovetail::branches {

BorderedSystem::BorderedSystem(const steady::Tangent& tangent, Eigen::VectorXd column, Eigen::VectorXd row,
                               double corner)
    : tangent_(tangent), column_(std::move(column)), row_(std::move(row)), corner_(corner) {
  if (tangent.factors().status() == Status::converged) by_column_ = tangent.solve(column_);
}

BorderedSystem::Defect BorderedSystem::defect(const Solution& at, const Eigen::VectorXd& forces,
                                              double constraint) const {
  const Eigen::Index nc = tangent_.problem().model().contact_size();
  const Eigen::MatrixXd change = at.displacement.reshaped(nc, at.displacement.size() / nc);
  const Eigen::MatrixXd applied = steady::apply_jacobian(tangent_.point(), change);
  return {.forces = forces - applied.reshaped() - at.parameter * column_,
          .constraint = constraint - row_.dot(at.displacement) - corner_ * at.parameter};
}

// Adds the solution for `defect` by block elimination.
void BorderedSystem::eliminate(const Defect& defect, Solution& solution) const {
  const Eigen::VectorXd direct = tangent_.solve(defect.forces);
  const double change = (defect.constraint - row_.dot(direct)) / (corner_ - row_.dot(by_column_));
  solution.displacement += direct - change * by_column_;
  solution.parameter += change;
}

BorderedSystem::Solution BorderedSystem::solve(const Eigen::VectorXd& forces, double constraint) const {
  if (tangent_.factors().status() != Status::converged || !by_column_.allFinite())
    return solve_densely(forces, constraint);
  Solution solution{.displacement = Eigen::VectorXd::Zero(forces.size())};
  // The size of the terms that cancel in each row decides what counts as zero.
  constexpr BorderedParams kParams;
  for (int pass = 0; pass <= kParams.refinements; ++pass) {
    Defect left{.forces = forces, .constraint = constraint};
    double size = forces.norm() + std::abs(solution.parameter) * column_.norm();
    if (pass > 0) left = defect(solution, forces, constraint);
    if (!left.forces.allFinite() || !std::isfinite(left.constraint)) break;
    const double reach = row_.norm() * solution.displacement.norm() + std::abs(corner_ * solution.parameter);
    const double force_error = size > 0 ? left.forces.norm() / size : 0;
    const double error = std::max(force_error, std::abs(left.constraint) / std::max(reach, std::abs(constraint)));
    if (pass > 0 && error <= (pass == kParams.refinements ? kParams.usable : kParams.exact)) {
      solution.status = Status::converged;
      return solution;
    }
    if (pass < kParams.refinements) eliminate(left, solution);
  }
  return solve_densely(forces, constraint);
}

BorderedSystem::Solution BorderedSystem::solve_densely(const Eigen::VectorXd& forces, double constraint) const {
  const Eigen::Index n = forces.size();
  // Rows and columns are brought to one size: forces by the largest entry of J, displacements and ds by their columns.
  Eigen::MatrixXd matrix(n + 1, n + 1);
  matrix.topLeftCorner(n, n) = steady::jacobian(tangent_.point());
  matrix.topRightCorner(n, 1) = column_;
  matrix.bottomLeftCorner(1, n) = row_.transpose();
  matrix(n, n) = corner_;
  Eigen::VectorXd right(n + 1);
  right << forces, constraint;
  const double largest = matrix.topRows(n).cwiseAbs().maxCoeff(), last = matrix.row(n).cwiseAbs().maxCoeff();
  if (!(largest > 0) || !(last > 0)) return {};
  matrix.topRows(n) /= largest;
  right.head(n) /= largest;
  matrix.row(n) /= last;
  right(n) /= last;
  const Eigen::RowVectorXd columns = matrix.cwiseAbs().colwise().maxCoeff();
  if (!(columns.minCoeff() > 0)) return {};
  matrix.array().rowwise() /= columns.array();
  const numerics::DenseLu lu(std::move(matrix));
  if (lu.status() != Status::converged || lu.reciprocal_condition() < BorderedParams{}.regular) return {};
  const Eigen::VectorXd found = Eigen::VectorXd(lu.solve(right)).cwiseQuotient(columns.transpose());
  return {.status = found.allFinite() ? Status::converged : Status::not_finite,
          .displacement = found.head(n),
          .parameter = found(n)};
}

Vector BorderedSystem::vector(const Solution& solution) const {
  const Eigen::Index rows = tangent_.problem().model().contact_size();
  return {.displacement = solution.displacement.reshaped(rows, solution.displacement.size() / rows),
          .parameter = solution.parameter};
}

}  // namespace dovetail::branches
