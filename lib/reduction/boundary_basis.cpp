#include "reduction/boundary_basis.hpp"

#include <Eigen/Dense>
#include <cmath>
#include <vector>

#include "numerics/dense_product.hpp"

namespace dovetail::reduction {

namespace {

// Linearly independent loads, each of unit length: cosine, sine and output vectors are often the same one.
Eigen::MatrixXd independent_loads(const FullModel& full) {
  Eigen::MatrixXd loads(full.size(), 1 + full.cosine_force.cols() + full.sine_force.cols() + full.outputs.cols());
  loads << full.static_force, full.cosine_force, full.sine_force, full.outputs;
  std::vector<Eigen::Index> loaded;
  for (Eigen::Index k = 0; k < loads.cols(); ++k)
    if (loads.col(k).squaredNorm() > 0) loaded.push_back(k);
  Eigen::MatrixXd unit = loads(Eigen::all, loaded);
  if (unit.cols() == 0) return unit;
  unit.colwise().normalize();
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(unit);
  qr.setThreshold(1e-12);
  const Eigen::VectorXi kept = qr.colsPermutation().indices().head(qr.rank());
  return unit(Eigen::all, kept);
}

// Projects the M-component of `basis` out of `x`; twice, because once leaves what cancels.
void remove(const Eigen::MatrixXd& basis, const Eigen::MatrixXd& mass_basis, Eigen::MatrixXd& x) {
  for (int pass = 0; pass < 2; ++pass) x -= basis * (mass_basis.transpose() * x).eval();
}

}  // namespace

Eigen::MatrixXd static_responses(const FullModel& full, const FloatingInverse& inverse, const FreeModes& modes,
                                 Eigen::Index limit) {
  // Loads lighter than this part of the response (its square root, in displacement) count as represented.
  constexpr double kNegligibleEnergy = 1e-20;
  constexpr double kParallel = 1e-9;
  const Eigen::MatrixXd loads = independent_loads(full);
  const Eigen::MatrixXd mass_modes = full.mass * modes.vectors;
  const Eigen::MatrixXd participation = modes.vectors.transpose() * loads;
  // Loads are freed of the soft modes before the solve, whose responses would dominate; only of these, because
  // the others are no exact eigenvectors and the static response is to be exact.
  const Eigen::Index soft = modes.soft();
  const Eigen::MatrixXd remaining = loads - mass_modes.leftCols(soft) * participation.topRows(soft);
  Eigen::MatrixXd x = inverse.apply(remaining);
  const Eigen::VectorXd whole = (x.array() * remaining.array()).colwise().sum();
  remove(modes.vectors, mass_modes, x);

  Eigen::MatrixXd kept(full.size(), std::min(limit, x.cols()));
  Eigen::Index count = 0;
  for (Eigen::Index k = 0; k < x.cols() && count < kept.cols(); ++k) {
    // The part of the response beyond the modes, against the whole of it without the soft ones.
    const double energy = x.col(k).dot(full.stiffness * x.col(k));
    if (!(energy > kNegligibleEnergy * std::abs(whole(k)))) continue;
    Eigen::MatrixXd candidate = x.col(k);
    const double size = std::sqrt(std::max(0.0, candidate.col(0).dot(full.mass * candidate.col(0))));
    if (!(size > 0)) continue;
    candidate /= size;
    const Eigen::MatrixXd earlier = kept.leftCols(count);
    remove(earlier, full.mass * earlier, candidate);
    const double left = std::sqrt(std::max(0.0, candidate.col(0).dot(full.mass * candidate.col(0))));
    if (left <= kParallel) continue;
    kept.col(count++) = candidate / left;
  }
  return kept.leftCols(count);
}

RitzBasis rayleigh_ritz(const FullModel& full, const Eigen::MatrixXd& vectors) {
  const Eigen::MatrixXd stiffness = vectors.transpose() * (full.stiffness * vectors);
  const Eigen::MatrixXd mass = vectors.transpose() * (full.mass * vectors);
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> ritz(0.5 * (stiffness + stiffness.transpose()),
                                                                       0.5 * (mass + mass.transpose()));
  return {.eigenvalues = ritz.eigenvalues(), .vectors = vectors * ritz.eigenvectors()};
}

ResidualFlexibility residual_flexibility(const ContactSolver& solver, const Eigen::SparseMatrix<double>& mass,
                                         const RitzBasis& basis, Eigen::Index low) {
  // K x + M Phi_0 mu = B^T with Phi_0^T M x = 0, internal dofs eliminated:
  //   x_r = (S + N d^-1 N^T)^-1, mu = d^-1 N^T x_r, x_i = T x_r - Y mu,
  //   Y = K_ii^-1 (M Phi_0)_i, N = (M Phi_0)_r + T^T (M Phi_0)_i, d = (M Phi_0)_i^T Y.
  const Eigen::Index internal = solver.internal_size();
  const Eigen::Index contact = solver.contact_size();
  const Eigen::Index m = basis.vectors.cols();
  ResidualFlexibility result;
  Eigen::MatrixXd schur = solver.schur();
  Eigen::MatrixXd response, border, scaled_border;
  if (low > 0) {
    const Eigen::MatrixXd inertia = mass * basis.vectors.leftCols(low);
    response = solver.solve_internal(inertia.topRows(internal));
    border = solver.condense(inertia);
    const Eigen::LLT<Eigen::MatrixXd> d(inertia.topRows(internal).transpose() * response);
    if (d.info() != Eigen::Success) {
      result.status = Status::singular;
      return result;
    }
    scaled_border = d.solve(border.transpose());
    schur += border * scaled_border;
  }
  const Eigen::LLT<Eigen::MatrixXd> factor(0.5 * (schur + schur.transpose()));
  if (factor.info() != Eigen::Success) {
    result.status = Status::singular;
    return result;
  }
  const Eigen::MatrixXd on_contact = factor.solve(Eigen::MatrixXd::Identity(contact, contact));

  const Eigen::MatrixXd high = basis.vectors.rightCols(m - low);
  const Eigen::MatrixXd high_contact = high.bottomRows(contact);
  const Eigen::MatrixXd represented =
      basis.eigenvalues.tail(m - low).cwiseInverse().asDiagonal() * high_contact.transpose();
  result.field = solver.expand(on_contact);
  if (low > 0) numerics::add_product(response, -(scaled_border * on_contact).eval(), result.field.topRows(internal));
  numerics::add_product(high, -represented, result.field);
  const Eigen::MatrixXd g = result.field.bottomRows(contact);
  result.contact = 0.5 * (g + g.transpose());
  if (!result.contact.allFinite()) result.status = Status::not_finite;
  return result;
}

}  // namespace dovetail::reduction
