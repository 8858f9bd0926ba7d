#include "fem/glued_modes.hpp"

#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

#include "fem/sector_system.hpp"

namespace dovetail::fem {

template <class Scalar>
numerics::Modes<Scalar> glued_modes(const Eigen::SparseMatrix<double>& stiffness,
                                    const Eigen::SparseMatrix<double>& mass, const Constraints<Scalar>& constraints,
                                    const numerics::ModesOptions& options, numerics::SparseCholesky<Scalar>& cholesky) {
  // Columns of the contact dofs never enter: constrain with those of the internal dofs only.
  Constraints<Scalar> glued;
  glued.transformation = constraints.transformation.leftCols(constraints.internal_count);
  glued.internal_count = constraints.internal_count;
  return numerics::smallest_modes<Scalar>(constrain(stiffness, glued), constrain(mass, glued), options, cholesky);
}

template numerics::Modes<double> glued_modes(const Eigen::SparseMatrix<double>&, const Eigen::SparseMatrix<double>&,
                                             const Constraints<double>&, const numerics::ModesOptions&,
                                             numerics::SparseCholesky<double>&);
template numerics::Modes<std::complex<double>> glued_modes(const Eigen::SparseMatrix<double>&,
                                                           const Eigen::SparseMatrix<double>&,
                                                           const Constraints<std::complex<double>>&,
                                                           const numerics::ModesOptions&,
                                                           numerics::SparseCholesky<std::complex<double>>&);

NodalDiameterFrequencies nodal_diameter_frequencies(const SectorMesh& sector,
                                                    const Eigen::SparseMatrix<double>& stiffness,
                                                    const Eigen::SparseMatrix<double>& mass, BoreSupport bore,
                                                    const numerics::ModesOptions& options,
                                                    std::span<const int> nodal_diameters) {
  NodalDiameterFrequencies result;
  result.nodal_diameters.assign(nodal_diameters.begin(), nodal_diameters.end());
  if (result.nodal_diameters.empty()) {
    result.nodal_diameters.resize(static_cast<std::size_t>(sector.sectors / 2 + 1));
    std::iota(result.nodal_diameters.begin(), result.nodal_diameters.end(), 0);
  }
  const Eigen::Index rows = static_cast<Eigen::Index>(result.nodal_diameters.size());
  result.frequency.setConstant(rows, options.count, std::numeric_limits<double>::quiet_NaN());
  result.status.assign(result.nodal_diameters.size(), Status::iteration_limit);

  // One analysis per scalar type serves all diameters: the patterns do not depend on the phase.
  numerics::SparseCholesky<double> real_cholesky;
  numerics::SparseCholesky<std::complex<double>> complex_cholesky;
  for (std::size_t k = 0; k < result.nodal_diameters.size(); ++k) {
    const int diameter = result.nodal_diameters[k];
    const auto store = [&](const auto& modes) {
      result.status[k] = modes.status;
      for (Eigen::Index m = 0; m < modes.eigenvalues.size(); ++m) {
        const double lambda = modes.eigenvalues[m];
        result.frequency(static_cast<Eigen::Index>(k), m) =
            std::copysign(std::sqrt(std::abs(lambda)), lambda) / (2 * std::numbers::pi);
      }
    };
    if (diameter == 0 || 2 * diameter == sector.sectors)
      store(glued_modes(stiffness, mass, real_constraints(sector, bore, diameter), options, real_cholesky));
    else
      store(glued_modes(stiffness, mass, complex_constraints(sector, bore, diameter), options, complex_cholesky));
  }
  return result;
}

}  // namespace dovetail::fem
