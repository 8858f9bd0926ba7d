#include "dynamics/harmonic_blocks.hpp"

#include <cassert>

#include "numerics/dense_product.hpp"

namespace dovetail::dynamics {

Eigen::MatrixXd apply_harmonics(const std::vector<const Eigen::MatrixXcd*>& matrices, Form form,
                                const Eigen::MatrixXd& x) {
  const bool turned = form == Form::transposed || form == Form::adjoint;
  const bool conjugated = form == Form::conjugated || form == Form::adjoint;
  const Eigen::MatrixXcd& first = *matrices.front();
  const Eigen::Index in = turned ? first.rows() : first.cols(), out = turned ? first.cols() : first.rows();
  const auto coefficients = 2 * static_cast<Eigen::Index>(matrices.size()) - 1;
  assert(x.rows() == in * coefficients);
  Eigen::MatrixXd result(out * coefficients, x.cols());
  // conj(A) x = conj(A conj(x)): amplitudes c + i s in and out instead of c - i s.
  const double sign = conjugated ? 1 : -1;
  Eigen::MatrixXcd amplitude(in, x.cols());
  for (std::size_t h = 0; h < matrices.size(); ++h) {
    const Eigen::Index cosine = h == 0 ? 0 : 2 * static_cast<Eigen::Index>(h) - 1, sine = cosine + 1;
    amplitude.real() = x.middleRows(cosine * in, in);
    if (h == 0)
      amplitude.imag().setZero();
    else
      amplitude.imag() = sign * x.middleRows(sine * in, in);
    // Harmonics that nothing is in are common: what wear moves directly has a mean alone.
    if (amplitude.isZero(0)) {
      result.middleRows(cosine * out, h == 0 ? out : 2 * out).setZero();
      continue;
    }
    const Eigen::MatrixXcd applied =
        turned ? numerics::transposed_product(*matrices[h], amplitude) : numerics::product(*matrices[h], amplitude);
    result.middleRows(cosine * out, out) = applied.real();
    if (h > 0) result.middleRows(sine * out, out) = sign * applied.imag();
  }
  return result;
}

}  // namespace dovetail::dynamics
