#include "dynamics/harmonic_blocks.hpp"

#include <cassert>

#include "numerics/dense_product.hpp"

namespace dovetail::dynamics {

Eigen::MatrixXcd amplitude(const Eigen::MatrixXd& x, Eigen::Index n, Eigen::Index h, bool conjugated) {
  Eigen::MatrixXcd result(n, x.cols());
  result.real() = x.middleRows((h == 0 ? 0 : 2 * h - 1) * n, n);
  if (h == 0)
    result.imag().setZero();
  else
    result.imag() = (conjugated ? 1 : -1) * x.middleRows(2 * h * n, n);
  return result;
}

void put_amplitude(const Eigen::MatrixXcd& amplitude, Eigen::Index h, bool conjugated, Eigen::MatrixXd& x) {
  const Eigen::Index n = amplitude.rows();
  x.middleRows((h == 0 ? 0 : 2 * h - 1) * n, n) = amplitude.real();
  if (h > 0) x.middleRows(2 * h * n, n) = (conjugated ? 1 : -1) * amplitude.imag();
}

Eigen::MatrixXd apply_harmonics(const std::vector<const Eigen::MatrixXcd*>& matrices, Form form,
                                const Eigen::MatrixXd& x) {
  const bool turned = form == Form::transposed || form == Form::adjoint;
  const bool conjugated = form == Form::conjugated || form == Form::adjoint;
  const Eigen::MatrixXcd& first = *matrices.front();
  const Eigen::Index in = turned ? first.rows() : first.cols(), out = turned ? first.cols() : first.rows();
  const auto coefficients = 2 * static_cast<Eigen::Index>(matrices.size()) - 1;
  assert(x.rows() == in * coefficients);
  Eigen::MatrixXd result(out * coefficients, x.cols());
  for (std::size_t i = 0; i < matrices.size(); ++i) {
    const auto h = static_cast<Eigen::Index>(i);
    // conj(A) x = conj(A conj(x))
    const Eigen::MatrixXcd there = amplitude(x, in, h, conjugated);
    // Harmonics that nothing is in are common: what wear moves directly has a mean alone.
    if (there.isZero(0))
      put_amplitude(Eigen::MatrixXcd::Zero(out, x.cols()), h, conjugated, result);
    else
      put_amplitude(turned ? numerics::transposed_product(*matrices[i], there) : numerics::product(*matrices[i], there),
                    h, conjugated, result);
  }
  return result;
}

}  // namespace dovetail::dynamics
