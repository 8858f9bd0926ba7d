#include "fem/diameter_basis.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "fem/glued_modes.hpp"
#include "fem/params.hpp"
#include "numerics/dense_product.hpp"
#include "numerics/dense_symmetric.hpp"
#include "numerics/sparse_product.hpp"

namespace dovetail::fem {

namespace {

using Complex = std::complex<double>;
using Sparse = Eigen::SparseMatrix<double>;
constexpr DiameterBasisParams kBasis = {};

/// T(phase) = Ta + e^{i phase} Tb: the parts from the glued transformation of one nodal diameter.
std::pair<Sparse, Sparse> transformation_parts(const SectorMesh& sector, const Eigen::SparseMatrix<Complex>& glued) {
  const double phase = 2 * std::numbers::pi / sector.sectors;
  const Sparse turning = Sparse(glued.imag()) / std::sin(phase);
  const Sparse constant = Sparse(glued.real()) - std::cos(phase) * turning;
  return {constant.pruned(1.0, kBasis.rounding), turning.pruned(1.0, kBasis.rounding)};
}

/// Of the node that a dof is nearest to being a displacement of.
Eigen::VectorXd places(const SectorMesh& sector, const Sparse& transformation) {
  const Eigen::MatrixXd& nodes = sector.mesh.nodes;
  Eigen::VectorXd place = Eigen::VectorXd::Zero(transformation.cols());
  for (Eigen::Index dof = 0; dof < transformation.cols(); ++dof) {
    double largest = 0;
    for (Sparse::InnerIterator entry(transformation, dof); entry; ++entry) {
      if (std::abs(entry.value()) <= largest) continue;
      largest = std::abs(entry.value());
      const Eigen::Index node = entry.row() / nodes.rows();
      place(dof) = std::atan2(nodes(0, node), nodes(1, node)) * sector.sectors / (2 * std::numbers::pi);
    }
  }
  return place;
}

PhaseMatrix phase_matrix(const Sparse& full, const Sparse& a, const Sparse& b) {
  const Sparse full_a = full * a, full_b = full * b;
  const Sparse at = a.transpose(), bt = b.transpose();
  const Sparse of_a = at * full_a, of_b = bt * full_b;
  return {.constant = of_a + of_b, .turning = at * full_b};
}

/// Gram-Schmidt, twice, of what is left of directions of length one beside the basis; less than a little is noise.
void orthonormalise(Eigen::MatrixXd& directions) {
  Eigen::Index count = 0;
  for (Eigen::Index k = 0; k < directions.cols(); ++k) {
    Eigen::VectorXd direction = directions.col(k);
    for (int pass = 0; pass < 2; ++pass)
      direction -= directions.leftCols(count) * (directions.leftCols(count).transpose() * direction);
    if (const double left = direction.norm(); left >= kBasis.fresh) directions.col(count++) = direction / left;
  }
  directions.conservativeResize(Eigen::NoChange, count);
}

Eigen::MatrixXcd product(const Eigen::MatrixXd& a, const Eigen::MatrixXcd& b) {
  Eigen::MatrixXcd result(a.rows(), b.cols());
  result.real() = numerics::product(a, Eigen::MatrixXd(b.real()));
  result.imag() = numerics::product(a, Eigen::MatrixXd(b.imag()));
  return result;
}

}  // namespace

Sparse PhaseMatrix::alike() const {
  return constant + turning + Sparse(turning.transpose());
}

Sparse PhaseMatrix::against() const {
  return constant - turning - Sparse(turning.transpose());
}

DiameterBasis::DiameterBasis(const SectorMesh& sector, const Sparse& stiffness, const Sparse& mass, BoreSupport bore,
                             const Eigen::VectorXd& flexibility) {
  const GluedJoint<Complex> one = glued_joint(complex_constraints(sector, bore, 1), flexibility);
  const auto [a, b] = transformation_parts(sector, one.constraints.transformation);
  place_ = places(sector, a);
  stiffness_.matrix = phase_matrix(stiffness, a, b);
  if (one.springs.nonZeros() > 0) stiffness_.matrix.constant += one.springs;
  mass_.matrix = phase_matrix(mass, a, b);
}

Eigen::MatrixXcd DiameterBasis::turned(double phase, const Eigen::MatrixXcd& vectors) const {
  Eigen::VectorXcd factors(place_.size());
  for (Eigen::Index dof = 0; dof < place_.size(); ++dof) factors(dof) = std::polar(1.0, phase * place_(dof));
  return factors.asDiagonal() * vectors;
}

void DiameterBasis::add(const Eigen::MatrixXcd& vectors) {
  Eigen::MatrixXd parts(vectors.rows(), 2 * vectors.cols());
  for (Eigen::Index m = 0; m < vectors.cols(); ++m) {
    parts.col(2 * m) = vectors.col(m).real();
    parts.col(2 * m + 1) = vectors.col(m).imag();
  }
  add(parts);
}

void DiameterBasis::add(const Eigen::MatrixXd& vectors) {
  Eigen::MatrixXd fresh(vectors.rows(), vectors.cols());
  Eigen::Index count = 0;
  for (Eigen::Index m = 0; m < vectors.cols(); ++m)
    if (const double length = vectors.col(m).norm(); length > 0) fresh.col(count++) = vectors.col(m) / length;
  fresh.conservativeResize(Eigen::NoChange, count);
  for (int pass = 0; pass < 2 && basis_.cols() > 0; ++pass)
    numerics::add_product(basis_, -numerics::transposed_product(basis_, fresh), fresh);
  orthonormalise(fresh);
  const Eigen::Index old = basis_.cols();
  basis_.conservativeResize(vectors.rows(), old + fresh.cols());
  basis_.rightCols(fresh.cols()) = fresh;
  stiffness_.grow(basis_);
  mass_.grow(basis_);
}

Eigen::VectorXd DiameterBasis::eigenvalues(double phase, Eigen::Index count) const {
  if (basis_.cols() < count) return {};  // nothing converged so far
  const numerics::Pairs<Complex> found = numerics::all_values<Complex>(stiffness_.reduced(phase), mass_.reduced(phase));
  if (found.status != Status::converged) return {};
  return found.values.head(count);
}

Eigen::MatrixXcd DiameterBasis::residuals(double phase, Eigen::Index count) const {
  count = std::min(count, basis_.cols());
  const numerics::Pairs<Complex> found = numerics::all_pairs<Complex>(stiffness_.reduced(phase), mass_.reduced(phase));
  if (found.status != Status::converged) return {};
  const Eigen::MatrixXcd y = found.vectors.leftCols(count), vectors = product(basis_, y);
  return stiffness_.times(phase, y, vectors) - mass_.times(phase, y, vectors) * found.values.head(count).asDiagonal();
}

Eigen::MatrixXcd DiameterBasis::OnBasis::reduced(double phase) const {
  Eigen::MatrixXcd result(constant.rows(), constant.cols());
  result.real() = constant + std::cos(phase) * (turning + turning.transpose());
  result.imag() = std::sin(phase) * (turning - turning.transpose());
  return result;
}

Eigen::MatrixXcd DiameterBasis::OnBasis::times(double phase, const Eigen::MatrixXcd& y,
                                               const Eigen::MatrixXcd& vectors) const {
  Eigen::MatrixXcd result = product(image, y);
  const Eigen::MatrixXd re = vectors.real(), im = vectors.imag();
  const auto add = [&](const auto& sparse, Complex factor) {
    const Eigen::MatrixXd of_re = sparse * re, of_im = sparse * im;
    result.real() += factor.real() * of_re - factor.imag() * of_im;
    result.imag() += factor.real() * of_im + factor.imag() * of_re;
  };
  add(matrix.turning, std::polar(1.0, phase));
  add(matrix.turning.transpose(), std::polar(1.0, -phase));
  return result;
}

void DiameterBasis::OnBasis::grow(const Eigen::MatrixXd& basis) {
  const Eigen::Index old = constant.rows(), size = basis.cols(), fresh = size - old;
  const Eigen::MatrixXd directions = basis.rightCols(fresh);
  const Eigen::MatrixXd turned = matrix.turning * directions, back = matrix.turning.transpose() * directions;
  image.conservativeResize(basis.rows(), size);
  image.rightCols(fresh) = numerics::symmetric_product(matrix.constant, directions);
  constant.conservativeResize(size, size);
  turning.conservativeResize(size, size);
  constant.rightCols(fresh) = numerics::transposed_product(basis, image.rightCols(fresh));
  constant.bottomLeftCorner(fresh, old) = constant.topRightCorner(old, fresh).transpose();
  turning.rightCols(fresh) = numerics::transposed_product(basis, turned);
  turning.bottomLeftCorner(fresh, old) = numerics::transposed_product(back, basis.leftCols(old));
}

}  // namespace dovetail::fem
