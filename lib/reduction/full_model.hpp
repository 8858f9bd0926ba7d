#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <memory>
#include <string>
#include <vector>

#include "numerics/partial_cholesky.hpp"
#include "reduction/reduced_model.hpp"

namespace dovetail::reduction {

/// The unreduced model in independent coordinates: internal ones first, the relative contact
/// displacements (N, T1[, T2] of each contact node in turn) last. With the contact dofs fixed at zero
/// the blade is glued to the disk and `stiffness` of the rest is positive definite; as a whole it may be
/// singular or, with spin softening, slightly indefinite (the blade floats).
struct FullModel {
  Eigen::SparseMatrix<double> stiffness;  ///< [n, n] N/m, symmetric, both triangles stored
  Eigen::SparseMatrix<double> mass;       ///< [n, n] kg
  Eigen::VectorXd static_force;           ///< [n] N
  Eigen::MatrixXd cosine_force;           ///< [n, H_f] N, column j-1 is harmonic j
  Eigen::MatrixXd sine_force;             ///< [n, H_f] N
  Eigen::MatrixXd outputs;                ///< [n, n_out], y = c^T u
  std::vector<std::string> output_names;  ///< [n_out]
  ContactNodes contact;                   ///< indices refer to the n coordinates
  /// To eliminate in, kept for models with the same pattern; null: each finds its own.
  std::shared_ptr<numerics::EliminationOrder> order;

  [[nodiscard]] Eigen::Index size() const { return stiffness.rows(); }
  [[nodiscard]] Eigen::Index contact_size() const { return contact.count() * contact.directions(); }
  [[nodiscard]] Eigen::Index internal_size() const { return size() - contact_size(); }
};

}  // namespace dovetail::reduction
