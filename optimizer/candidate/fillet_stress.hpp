#pragma once

#include <Eigen/Core>
#include <span>

#include "optimizer/candidate/candidate_model.hpp"
#include "steady/state.hpp"

namespace dovetail::optimizer {

/// Stress on a fillet while the blade vibrates.
struct FilletStress {
  double aggregate = 0;  ///< Kreisselmeier-Steinhauser aggregate along the fillets, weighted by the nodes' share, Pa
  double maximum = 0;    ///< largest nodal value among the nodes that count in full, Pa
  double aggregate_error = 0, maximum_error = 0;  ///< what knowing that nothing acts on the fillet changed in them, Pa
  Eigen::VectorXd nodal;                          ///< [nodes] largest von Mises stress over one period, Pa
};

/// Fourier coefficients of the displacement of all nodes in a converged steady state with its tangent, [n, 2H+1]. Cost:
/// a back-solve of the full model for each.
[[nodiscard]] Eigen::MatrixXd displacement_field(const CandidateModel& candidate, const steady::State& state);

/// Von Mises stress (plane strain) at `nodes`, largest over one period of a displacement `field`: spin-up and vibration
/// together. Nodal means of the elements' stresses, corrected by what is known on a free surface
/// (fem::on_free_surface). `share` [nodes] is that of fem::SectorMesh.
[[nodiscard]] FilletStress fillet_stress(const Scene& scene, const CandidateModel& candidate,
                                         const Eigen::MatrixXd& field, std::span<const int> nodes,
                                         const Eigen::VectorXd& share, double poisson_ratio);

}  // namespace dovetail::optimizer
