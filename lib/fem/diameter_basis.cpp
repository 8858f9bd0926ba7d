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

Eigen::MatrixXcd product(const Eigen::Ref<const Eigen::MatrixXd>& a, const Eigen::MatrixXcd& b) {
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
  PhaseMatrix of_stiffness = phase_matrix(stiffness, a, b);
  if (one.springs.nonZeros() > 0) of_stiffness.constant += one.springs;
  stiffness_.emplace(std::move(of_stiffness));
  mass_.emplace(phase_matrix(mass, a, b));
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
  for (int pass = 0; pass < 2 && size_ > 0; ++pass)
    numerics::add_product(basis(), -numerics::transposed_product(basis(), fresh), fresh);
  orthonormalise(fresh);
  if (fresh.cols() == 0) return;
  const Eigen::Index grown = size_ + fresh.cols();
  if (grown > held_.cols()) held_.conservativeResize(vectors.rows(), std::max(grown, 2 * held_.cols()));
  held_.middleCols(size_, fresh.cols()) = fresh;
  size_ = grown;
  stiffness_->grow(basis(), fresh.cols());
  mass_->grow(basis(), fresh.cols());
}

Eigen::VectorXd DiameterBasis::eigenvalues(double phase, Eigen::Index count) const {
  if (size_ < count) return {};  // nothing converged so far
  const numerics::Pairs<Complex> found =
      numerics::all_values<Complex>(stiffness_->reduced(phase), mass_->reduced(phase));
  if (found.status != Status::converged) return {};
  return found.values.head(count);
}

Eigen::MatrixXcd DiameterBasis::residuals(double phase, Eigen::Index count) const {
  count = std::min(count, size_);
  const numerics::Pairs<Complex> found =
      numerics::all_pairs<Complex>(stiffness_->reduced(phase), mass_->reduced(phase));
  if (found.status != Status::converged) return {};
  const Eigen::MatrixXcd vectors = product(basis(), found.vectors.leftCols(count));
  return stiffness_->times(phase, vectors) - mass_->times(phase, vectors) * found.values.head(count).asDiagonal();
}

DiameterBasis::OnBasis::OnBasis(PhaseMatrix of) : matrix(std::move(of)) {
  const Sparse& turns = matrix.turning;
  constexpr Eigen::Index kNone = -1;
  std::vector<Eigen::Index> place(static_cast<std::size_t>(turns.rows()), kNone);
  std::vector<Eigen::Triplet<double>> entries;
  for (Eigen::Index dof = 0; dof < turns.cols(); ++dof) {
    Sparse::InnerIterator entry(turns, dof);
    if (entry) columns.push_back(dof);
    for (; entry; ++entry) {
      Eigen::Index& row = place[static_cast<std::size_t>(entry.row())];
      if (row == kNone) {
        row = static_cast<Eigen::Index>(rows.size());
        rows.push_back(entry.row());
      }
      entries.emplace_back(static_cast<int>(row), static_cast<int>(columns.size()) - 1, entry.value());
    }
  }
  cuts.resize(static_cast<Eigen::Index>(rows.size()), static_cast<Eigen::Index>(columns.size()));
  cuts.setFromTriplets(entries.begin(), entries.end());
}

Eigen::MatrixXcd DiameterBasis::OnBasis::reduced(double phase) const {
  Eigen::MatrixXcd result(constant.rows(), constant.cols());
  result.real() = constant + std::cos(phase) * (turning + turning.transpose());
  result.imag() = std::sin(phase) * (turning - turning.transpose());
  return result;
}

Eigen::MatrixXcd DiameterBasis::OnBasis::times(double phase, const Eigen::MatrixXcd& vectors) const {
  const Eigen::Index count = vectors.cols();
  Eigen::MatrixXd parts(vectors.rows(), 2 * count);
  parts << vectors.real(), vectors.imag();
  const auto joined = [count](const Eigen::MatrixXd& of_parts, Complex factor) {
    const auto re = of_parts.leftCols(count), im = of_parts.rightCols(count);
    Eigen::MatrixXcd result(of_parts.rows(), count);
    result.real() = factor.real() * re - factor.imag() * im;
    result.imag() = factor.real() * im + factor.imag() * re;
    return result;
  };
  Eigen::MatrixXcd result = joined(numerics::symmetric_product(matrix.constant, parts), 1);
  result(rows, Eigen::all) += joined(cuts * parts(columns, Eigen::all), std::polar(1.0, phase));
  result(columns, Eigen::all) += joined(cuts.transpose() * parts(rows, Eigen::all), std::polar(1.0, -phase));
  return result;
}

void DiameterBasis::OnBasis::grow(const Eigen::Ref<const Eigen::MatrixXd>& basis, Eigen::Index fresh) {
  const Eigen::Index size = basis.cols(), old = size - fresh;
  constant.conservativeResize(size, size);
  constant.rightCols(fresh) =
      numerics::transposed_product(basis, numerics::symmetric_product(matrix.constant, basis.rightCols(fresh)));
  constant.bottomLeftCorner(fresh, old) = constant.topRightCorner(old, fresh).transpose();
  const Eigen::MatrixXd in_rows = basis(rows, Eigen::all), in_columns = basis(columns, Eigen::all);
  const Eigen::MatrixXd turned = cuts * in_columns.rightCols(fresh), back = cuts.transpose() * in_rows.rightCols(fresh);
  turning.conservativeResize(size, size);
  turning.rightCols(fresh) = numerics::transposed_product(in_rows, turned);
  turning.bottomLeftCorner(fresh, old) = numerics::transposed_product(back, in_columns.leftCols(old));
}

}  // namespace dovetail::fem
