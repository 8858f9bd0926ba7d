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
  std::vector<bool> solved;    ///< per diameter: by its own sparse eigenproblem, not from its neighbours' modes
};

/// Computes them for the diameters asked for (ascending, each 0..sectors/2), or all when the list is empty.
///
/// The constrained matrices depend on the phase between sectors as K0 + e^{i phase} K1 + e^{-i phase} K1^T, so the
/// modes are smooth functions of it. With a tolerance, the sparse problem is solved at the ends of the list and in the
/// middle of every interval in which Rayleigh-Ritz on the real and imaginary parts of the modes found so far misses the
/// middle's frequencies by more than it; inside an interval that passed, Ritz values serve. They are upper bounds of
/// the frequencies, and the middle just checked is in their basis, so errors are below the tolerance checked there.
/// Cost: a sparse factorisation for every diameter solved, five to nine of 24 with tolerance 1e-6.
[[nodiscard]] NodalDiameterFrequencies nodal_diameter_frequencies(const SectorMesh& sector,
                                                                  const Eigen::SparseMatrix<double>& stiffness,
                                                                  const Eigen::SparseMatrix<double>& mass,
                                                                  BoreSupport bore, const DiameterOptions& options,
                                                                  std::span<const int> nodal_diameters = {});

}  // namespace dovetail::fem
