#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <span>
#include <vector>

#include "core/status.hpp"
#include "fem/constraints.hpp"
#include "numerics/sparse_modes.hpp"

namespace dovetail::fem {

struct DiameterOptions {
  numerics::ModesOptions modes = {};
  /// >= 0. Relative error of a frequency; 0: the sparse eigenproblem is solved at every diameter.
  double tolerance = 0;
  /// Of springs between the flanks, through which the joint is glued: [contact dofs] m/N, 0: rigid; empty: all are.
  Eigen::VectorXd contact_flexibility = {};
};

/// Natural frequencies of the glued bladed disk over its nodal diameters.
struct NodalDiameterFrequencies {
  std::vector<int> nodal_diameters;
  Eigen::MatrixXd frequency;   ///< [diameters, modes] Hz, ascending; negative for -sqrt(-lambda)/(2 pi) (unstable)
  std::vector<Status> status;  ///< per diameter
  std::vector<bool> solved;    ///< per diameter: from residuals of its own, not from its neighbours' modes alone
};

/// Computes them for the diameters asked for (ascending, each 0..sectors/2), or all when the list is empty.
///
/// The constrained matrices depend on the phase between sectors as K0 + e^{i phase} K1 + e^{-i phase} K1^T, so the
/// modes are smooth functions of it. With a tolerance, the sparse problem is solved at the two phases where it is real,
/// 0 and pi. Between them Rayleigh-Ritz on the real and imaginary parts of what was found so far serves; residuals,
/// turned to the nearer real phase, divided by its factors and turned back, join that basis until the frequencies stay:
/// at the ends of the list and in the middle of every interval in which those of the middle were missed by more than
/// the tolerance. Ritz values are upper bounds of the frequencies. Cost: two real factorisations, and some hundred
/// solves with them; without a tolerance, or where rounds do not come to an end, a complex factorisation for every
/// diameter.
[[nodiscard]] NodalDiameterFrequencies nodal_diameter_frequencies(const SectorMesh& sector,
                                                                  const Eigen::SparseMatrix<double>& stiffness,
                                                                  const Eigen::SparseMatrix<double>& mass,
                                                                  BoreSupport bore, const DiameterOptions& options,
                                                                  std::span<const int> nodal_diameters = {});

}  // namespace dovetail::fem
