#include "numerics/gmres.hpp"

#include <Eigen/QR>
#include <Eigen/SVD>

namespace dovetail::numerics {

GmresResult gmres(const NearSystem& system, const Eigen::VectorXd& b, const GmresOptions& options) {
  GmresResult result;
  result.x = Eigen::VectorXd::Zero(b.size());
  const double length = b.norm();
  if (!b.allFinite()) {
    result.status = Status::not_finite;
    return result;
  }
  if (length == 0) {
    result.residual = 0;
    result.status = Status::converged;
    return result;
  }
  // A directions = basis hessenberg, directions = P^-1 basis
  Eigen::MatrixXd basis(b.size(), options.most + 1), directions;
  Eigen::MatrixXd hessenberg = Eigen::MatrixXd::Zero(options.most + 1, options.most);
  basis.col(0) = b / length;
  Eigen::VectorXd combination;
  while (result.status == Status::iteration_limit && result.products < options.most) {
    const Eigen::Index k = result.products++;
    const Eigen::VectorXd direction = system.near_solve(basis.col(k));
    Eigen::VectorXd image = system.apply(direction, basis.col(k));
    if (k == 0) directions.resize(direction.size(), options.most);
    directions.col(k) = direction;
    if (!image.allFinite()) {
      result.status = Status::not_finite;
      return result;
    }
    for (int pass = 0; pass < 2; ++pass) {
      const Eigen::VectorXd along = basis.leftCols(k + 1).transpose() * image;
      image.noalias() -= basis.leftCols(k + 1) * along;
      hessenberg.col(k).head(k + 1) += along;
    }
    const double left = image.norm();
    hessenberg(k + 1, k) = left;
    basis.col(k + 1) = left > 0 ? Eigen::VectorXd(image / left) : image;
    const auto so_far = hessenberg.topLeftCorner(k + 2, k + 1);
    const Eigen::VectorXd first = Eigen::VectorXd::Unit(k + 2, 0);
    combination = so_far.householderQr().solve(first);
    result.residual = (first - so_far * combination).norm();
    if (result.residual <= options.tolerance) result.status = Status::converged;
  }
  if (result.products == 0) return result;
  result.x = length * (directions.leftCols(result.products) * combination);
  result.least_stretch =
      Eigen::JacobiSVD<Eigen::MatrixXd>(hessenberg.topLeftCorner(result.products + 1, result.products))
          .singularValues()
          .minCoeff();
  return result;
}

}  // namespace dovetail::numerics
