#include "reduction/boundary_basis.hpp"

#include <cmath>
#include <vector>

#include "numerics/dense_general.hpp"
#include "numerics/dense_product.hpp"
#include "numerics/dense_symmetric.hpp"
#include "numerics/sparse_product.hpp"
#include "reduction/params.hpp"

namespace dovetail::reduction {

namespace {

constexpr ResponseParams kResponse = {};

// Linearly independent loads, each of unit length: cosine, sine and output vectors are often the same one.
Eigen::MatrixXd independent_loads(const FullModel& full) {
  Eigen::MatrixXd loads(full.size(), 1 + full.cosine_force.cols() + full.sine_force.cols() + full.outputs.cols());
  loads << full.static_force, full.cosine_force, full.sine_force, full.outputs;
  std::vector<Eigen::Index> loaded;
  for (Eigen::Index k = 0; k < loads.cols(); ++k)
    if (loads.col(k).squaredNorm() > 0) loaded.push_back(k);
  Eigen::MatrixXd unit = loads(Eigen::all, loaded);
  unit.colwise().normalize();
  return unit(Eigen::all, numerics::independent_columns(unit, kResponse.dependent));
}

// Projects the M-component of `basis` out of `x`; twice, because once leaves what cancels.
void remove(const Eigen::MatrixXd& basis, const Eigen::MatrixXd& mass_basis, Eigen::MatrixXd& x) {
  for (int pass = 0; pass < 2; ++pass) x -= numerics::product(basis, numerics::transposed_product(mass_basis, x));
}

}  // namespace

Eigen::MatrixXd static_responses(const FullModel& full, const FloatingInverse& inverse, const FreeModes& modes,
                                 Eigen::Index limit) {
  const Eigen::SparseMatrix<double>& mass = inverse.mass();
  const Eigen::MatrixXd loads = independent_loads(full);
  const Eigen::MatrixXd mass_modes = mass * modes.vectors;
  const Eigen::MatrixXd participation = numerics::transposed_product(modes.vectors, loads);
  // Loads are freed of the soft modes before the solve, whose responses would dominate; only of these, because
  // the others are no exact eigenvectors and the static response is to be exact.
  const Eigen::Index soft = modes.soft();
  const Eigen::MatrixXd remaining =
      loads - numerics::product(Eigen::MatrixXd(mass_modes.leftCols(soft)), participation.topRows(soft));
  Eigen::MatrixXd x = inverse.apply(remaining);
  const Eigen::VectorXd whole = (x.array() * remaining.array()).colwise().sum();
  remove(modes.vectors, mass_modes, x);

  Eigen::MatrixXd kept(full.size(), std::min(limit, x.cols()));
  Eigen::Index count = 0;
  for (Eigen::Index k = 0; k < x.cols() && count < kept.cols(); ++k) {
    // The part of the response beyond the modes, against the whole of it without the soft ones.
    const double energy = x.col(k).dot(full.stiffness * x.col(k));
    if (!(energy > kResponse.negligible * std::abs(whole(k)))) continue;
    Eigen::MatrixXd candidate = x.col(k);
    const double size = std::sqrt(std::max(0.0, candidate.col(0).dot(mass * candidate.col(0))));
    if (!(size > 0)) continue;
    candidate /= size;
    const Eigen::MatrixXd earlier = kept.leftCols(count);
    remove(earlier, mass * earlier, candidate);
    const double left = std::sqrt(std::max(0.0, candidate.col(0).dot(mass * candidate.col(0))));
    if (left <= kResponse.parallel) continue;
    kept.col(count++) = candidate / left;
  }
  return kept.leftCols(count);
}

RitzBasis rayleigh_ritz(const Eigen::SparseMatrix<double>& stiffness, const Eigen::SparseMatrix<double>& mass,
                        const Eigen::MatrixXd& vectors) {
  const Eigen::MatrixXd k = numerics::transposed_product(vectors, numerics::symmetric_product(stiffness, vectors));
  const Eigen::MatrixXd m = numerics::transposed_product(vectors, numerics::symmetric_product(mass, vectors));
  numerics::SymmetricPairs ritz = numerics::all_pairs<double>(k, m);
  return {.eigenvalues = std::move(ritz.values), .vectors = numerics::product(vectors, ritz.vectors)};
}

}  // namespace dovetail::reduction
