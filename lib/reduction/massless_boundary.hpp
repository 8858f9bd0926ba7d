#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/options.hpp"
#include "core/status.hpp"
#include "reduction/full_model.hpp"
#include "reduction/recovery.hpp"
#include "reduction/reduced_model.hpp"
#include "reduction/residual_flexibility.hpp"
#include "reduction/stiffness_change.hpp"

namespace dovetail::reduction {

struct ReductionOptions {
  /// >= 0. Free-interface modes kept, rigid ones included; static responses to the loads come on top.
  int modes = 20;
  /// >= 0. Modal damping of the glued linear modes, C = diag(2 zeta omega).
  double damping_ratio = 1e-3;
  /// 0 < . < 1. Relative residual of the free-interface modes; eigenvalues err by its square, static responses do not.
  /// With 0.1, for 0.6 of the solves, flanks that are alike come apart, and 2 of 25 sections found no resonance.
  double eigen_tolerance = 1e-4;
};

/// How the modes of a structure were found, and what they are.
struct ModesRecord {
  Status status = Status::converged;
  std::string message;                    ///< why, when not converged
  double first_neglected_eigenvalue = 0;  ///< (rad/s)^2, infinite when no mode is neglected
  int rigid_modes = 0;                    ///< eigenvalues that are zero to rounding
  int negative_modes = 0;                 ///< negative eigenvalues of the full stiffness (spin softening)
  double seconds_factorisation = 0, seconds_contact_solves = 0, seconds_modes = 0;
};

/// Massless-boundary reduction [Monjaraz-Tec et al. 2022, arXiv 2111.07693; MacNeal 1971] and all that is
/// needed to go back to the full model.
struct Reduction : ModesRecord {
  ReducedModel model;                 ///< coordinates [contact r (node by node: N, T1[, T2]); glued modes q]
  Recovery recovery;                  ///< u = Phi q + Psi lambda
  Eigen::VectorXd free_eigenvalues;   ///< [m] Lambda of the basis, (rad/s)^2, ascending; may be negative
  Eigen::VectorXd glued_frequencies;  ///< [m] angular frequencies of the glued modes, rad/s, ascending
};

/// What a structure is at the trace of its contact, before contact nodes are laid on it: free-interface modes and the
/// flexibility they leave. To lay other contact nodes on the same trace takes dense algebra of their number only.
/// Holds the factors of the stiffness, for fields to come.
struct TraceModel : ModesRecord {
  std::shared_ptr<const ResidualFlexibility> structure;    ///< Phi [n, m], Lambda [m] and X [n, nt], n the full size
  Eigen::MatrixXd static_force, cosine_force, sine_force;  ///< Phi^T f [m, 1], [m, H_f], [m, H_f]
  Eigen::MatrixXd outputs;                                 ///< Phi^T c [m, n_out]
  std::vector<std::string> output_names;
  ContactNodes contact;                           ///< the trace's own nodes
  std::shared_ptr<const StiffnessChange> change;  ///< null: none
};

using Factor = std::shared_ptr<const numerics::PartialCholesky>;

/// First half of `reduce`, for `full` with its trace as contact. Cost and statuses as there.
/// - `known`: the factor of its stiffness, if there is one
[[nodiscard]] TraceModel trace_model(const FullModel& full, const ReductionOptions& options = {},
                                     const Factor& known = {});

/// Second half, with other contact nodes on the trace: their relative displacements are u = A v, v the trace's and A
/// `average` [nodes, trace nodes] for each direction, and their forces act on the trace as A^T lambda. Between them
/// the trace is free to deform. `contact`: what the nodes are like; its dof numbers are set here. Glued modes, and with
/// them the damping, are those of u = 0. A change D of the stiffness adds Psi^T D Psi, Psi the fields of unit
/// coordinates: displacements, frequencies and fields err like its square.
[[nodiscard]] Reduction reduce(const TraceModel& trace, const Eigen::SparseMatrix<double>& average,
                               ContactNodes contact, double damping_ratio);

/// Angular frequencies of the structure glued at every trace node, rad/s, ascending; NaN when the flexibility of the
/// trace is not positive definite.
[[nodiscard]] Eigen::VectorXd glued_frequencies(const TraceModel& trace);

/// Reduces `full` to its contact dofs without mass and m coordinates with unit mass:
///   K_red = [[G^-1, -G^-1 Phi_r], [-Phi_r^T G^-1, Lambda + Phi_r^T G^-1 Phi_r]],  M_red = diag(0, I),
/// with Phi the lowest free-interface modes and the static responses to all loads and outputs, and
/// G = B (K^-1 - Phi Lambda^-1 Phi^T) B^T the residual flexibility of the contact; q is then rotated to the
/// glued modes. Static responses are exact; dynamic ones err like (omega/omega_cut)^2.
/// The stiffness may be singular or indefinite, but not with the contact dofs fixed.
/// Throws InputError for inconsistent sizes and options out of range. Statuses: `singular` (the glued
/// structure is not positive definite, or G is not: too many modes for the model), `iteration_limit`
/// (modes), `not_finite`.
/// Cost: one sparse factorisation and about 5 modes back-solves.
[[nodiscard]] Reduction reduce(const FullModel& full, const ReductionOptions& options = {});

}  // namespace dovetail::reduction

namespace dovetail {
template <>
std::span<const Field<reduction::ReductionOptions>> option_table<reduction::ReductionOptions>();
}
