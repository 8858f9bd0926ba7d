#pragma once

#include <Eigen/Dense>
#include <Eigen/SparseCholesky>
#include <limits>
#include <numeric>
#include <span>
#include <vector>

#include "reduction/massless_boundary.hpp"

namespace dovetail::reduction {

/// Relative errors (Frobenius norm) of the undamped condensed dynamic stiffness
/// Z(w) = D_rr - D_ri D_ii^-1 D_ir, D = K - w^2 M, and of its inverse, at one angular frequency.
struct StiffnessError {
  double angular_frequency = 0;  ///< rad/s
  double stiffness = 0;          ///< |Z_red - Z| / |Z|
  double flexibility = 0;        ///< |Z_red^-1 - Z^-1| / |Z^-1|
};

/// Z of a reduced model whose contact dofs come first, without damping, [nc, nc] N/m.
inline Eigen::MatrixXd condensed_stiffness(const ReducedModel& model, double angular_frequency) {
  const Eigen::Index contact = model.contact.count() * model.contact.directions(), internal = model.size() - contact;
  const Eigen::MatrixXd dynamic = model.stiffness - angular_frequency * angular_frequency * model.mass;
  const Eigen::MatrixXd corner = dynamic.topLeftCorner(contact, contact);
  if (internal == 0) return corner;
  const Eigen::MatrixXd coupling = dynamic.bottomLeftCorner(internal, contact);
  return corner - coupling.transpose() * dynamic.bottomRightCorner(internal, internal).partialPivLu().solve(coupling);
}

/// Z of the full model without damping, by one sparse LDL^T of D_ii. Undamped on both sides because the modal damping
/// of the reduced model has no sparse counterpart in the full one; at a glued resonance Z, at a free one Z^-1, is
/// unbounded, so choose frequencies away from them. Empty when D_ii is singular.
inline Eigen::MatrixXd condensed_stiffness(const FullModel& model, double angular_frequency) {
  const Eigen::Index contact = model.contact_size();
  const Eigen::Index internal = model.internal_size();
  const Eigen::SparseMatrix<double> dynamic = model.stiffness - angular_frequency * angular_frequency * model.mass;
  const Eigen::SparseMatrix<double> interior = dynamic.topLeftCorner(internal, internal);
  const Eigen::SparseMatrix<double> coupling = dynamic.topRightCorner(internal, contact);
  const Eigen::SparseMatrix<double> corner = dynamic.bottomRightCorner(contact, contact);
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor(interior);
  if (factor.info() != Eigen::Success) return {};
  const Eigen::MatrixXd dense_coupling(coupling);
  Eigen::MatrixXd response = factor.solve(dense_coupling);
  // LDL^T without pivoting loses digits on an indefinite matrix; one refinement gives them back.
  response += factor.solve(dense_coupling - interior * response);
  return Eigen::MatrixXd(corner) - coupling.transpose() * response;
}

/// Compares with the full model: one factorisation and nc back-solves per frequency.
inline std::vector<StiffnessError> compare(const FullModel& full, const Reduction& reduction,
                                           std::span<const double> angular_frequencies) {
  std::vector<StiffnessError> errors;
  for (double angular_frequency : angular_frequencies) {
    const Eigen::MatrixXd exact = condensed_stiffness(full, angular_frequency);
    const Eigen::MatrixXd reduced = condensed_stiffness(reduction.model, angular_frequency);
    StiffnessError error{.angular_frequency = angular_frequency,
                         .stiffness = std::numeric_limits<double>::infinity(),
                         .flexibility = std::numeric_limits<double>::infinity()};
    if (exact.size() > 0 && exact.rows() == reduced.rows()) {
      error.stiffness = (reduced - exact).norm() / exact.norm();
      const Eigen::MatrixXd inverse = exact.partialPivLu().inverse();
      error.flexibility = (reduced.partialPivLu().inverse() - inverse).norm() / inverse.norm();
    }
    errors.push_back(error);
  }
  return errors;
}

}  // namespace dovetail::reduction
