#include "fem/glued_modes.hpp"

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

}  // namespace dovetail::fem
