#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "contact/wear_law.hpp"

namespace dovetail::reduction {

/// Contact nodes of a reduced model. Nc nodes with one normal and d-1 = 1 or 2 tangential directions.
struct ContactNodes {
  Eigen::VectorXi normal;                                    ///< [Nc] index of the dof that is u_N (closing positive)
  Eigen::MatrixXi tangential;                                ///< [Nc, d-1] indices of the tangential dofs
  Eigen::VectorXd area;                                      ///< [Nc] m^2, > 0
  Eigen::VectorXd gap;                                       ///< [Nc] initial gap g, m (negative: interference)
  Eigen::VectorXd friction;                                  ///< [Nc] mu >= 0
  std::string wear_law{contact::wear_laws().front()->name};  ///< one of contact::wear_laws()
  Eigen::VectorXd wear_coefficient;                          ///< [Nc] >= 0, of that law, in its unit
  Eigen::VectorXd wear_threshold;  ///< [Nc] >= 0, in its unit; empty: zero, or the law has none
  Eigen::MatrixX3d position;       ///< [Nc, 3] m, or empty
  Eigen::VectorXi group;           ///< [Nc] flank of the node, or empty
  Eigen::MatrixXd slip_origin;     ///< [Nc, d-1] tangential slip X_T at which the march starts, m (zeros by default)

  [[nodiscard]] Eigen::Index count() const { return normal.size(); }
  [[nodiscard]] Eigen::Index directions() const { return 1 + tangential.cols(); }  ///< d
};

/// M q'' + C q' + K q + lambda = f(t) in a few coordinates: relative contact displacements and internal
/// ones. f = static + sum_j cosine_j cos(j w t) + sine_j sin(j w t). Matrices symmetric; the stiffness
/// may be singular while contact holds the body; mass may be zero on contact dofs or altogether.
struct ReducedModel {
  Eigen::MatrixXd mass, damping, stiffness;  ///< [n, n] kg, N s/m, N/m
  ContactNodes contact;
  Eigen::VectorXd static_force;              ///< [n] N
  Eigen::MatrixXd cosine_force, sine_force;  ///< [H_f, n] N, row j-1 is harmonic j
  Eigen::MatrixXd output_vectors;            ///< [n_out, n], y = c^T q
  std::vector<std::string> output_names;     ///< [n_out]

  [[nodiscard]] Eigen::Index size() const { return stiffness.rows(); }
};

}  // namespace dovetail::reduction
