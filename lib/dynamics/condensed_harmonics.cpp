#include <cmath>
#include <numbers>
#include <utility>

#include "dynamics/condensed_model.hpp"
#include "dynamics/params.hpp"
#include "numerics/dense_lu.hpp"
#include "numerics/dense_product.hpp"

// What a condensed model answers for one harmonic at one frequency.
namespace dovetail::dynamics {

using Complex = std::complex<double>;

struct CondensedModel::Dynamic {
  Complex damping, mass;              // S = K + damping C + mass M
  Complex damping_slope, mass_slope;  // dS/dw
  Dynamic(int h, double omega)
      : damping(0, h * omega),
        mass(-std::pow(h * omega, 2), 0),
        damping_slope(0, h),
        mass_slope(-2.0 * h * h * omega, 0) {}
  [[nodiscard]] Eigen::MatrixXcd value(const Eigen::MatrixXd& k, const Eigen::MatrixXd& c,
                                       const Eigen::MatrixXd& m) const {
    Eigen::MatrixXcd s(k.rows(), k.cols());
    s.real() = k + mass.real() * m;
    s.imag() = damping.imag() * c;
    return s;
  }
  [[nodiscard]] Eigen::MatrixXcd slope(const Eigen::MatrixXd& c, const Eigen::MatrixXd& m) const {
    Eigen::MatrixXcd s(c.rows(), c.cols());
    s.real() = mass_slope.real() * m;
    s.imag() = damping_slope.imag() * c;
    return s;
  }
};

Eigen::MatrixXcd CondensedModel::solve_internal(const Eigen::MatrixXcd& internal, const Eigen::MatrixXcd& rhs,
                                                Status* status) const {
  if (rhs.rows() == 0) return rhs;
  if (modal_) {
    for (Eigen::Index j = 0; j < internal.rows(); ++j)
      if (internal(j, 0) == Complex(0, 0)) {
        *status = Status::singular;
        return Eigen::MatrixXcd::Zero(rhs.rows(), rhs.cols());
      }
    return internal.col(0).cwiseInverse().asDiagonal() * rhs;
  }
  const numerics::ComplexLu lu(internal);
  if (!(lu.reciprocal_condition() > CondensationParams{}.resonance)) *status = Status::singular;
  if (lu.status() != Status::converged) return Eigen::MatrixXcd::Zero(rhs.rows(), rhs.cols());
  return lu.solve(rhs);
}

CondensedHarmonic CondensedModel::harmonic(int h, double omega, double static_scale) const {
  CondensedHarmonic at;
  const Dynamic dynamic(h, omega);
  const Eigen::Index nc = contact_size();
  const Eigen::MatrixXcd ci = dynamic.value(stiffness_.ci, damping_.ci, mass_.ci);
  const Eigen::MatrixXcd ii = dynamic.value(stiffness_.ii, damping_.ii, mass_.ii);
  const bool forced = h <= force_harmonics();
  const double scale = h == 0 ? static_scale : 1.0;
  Eigen::VectorXcd internal_force = Eigen::VectorXcd::Zero(ci.cols());
  at.force = Eigen::VectorXcd::Zero(nc);
  if (forced) {
    internal_force = scale * force_internal_.col(h);
    at.force = scale * force_contact_.col(h);
  }
  Eigen::MatrixXcd rhs(ci.cols(), nc + 1);
  rhs << ci.transpose(), internal_force;
  const Eigen::MatrixXcd solved = solve_internal(ii, rhs, &at.status);
  at.internal_shape = solved.leftCols(nc);
  at.internal_force = solved.col(nc);
  at.force -= ci * at.internal_force;
  return at;
}

Eigen::MatrixXcd CondensedModel::stiffness(int h, double omega, const CondensedHarmonic& at) const {
  const Dynamic dynamic(h, omega);
  Eigen::MatrixXcd stiffness = dynamic.value(stiffness_.cc, damping_.cc, mass_.cc);
  if (stiffness_.ci.cols() == 0) return stiffness;
  if (h == 0)
    stiffness.real() -= numerics::product(stiffness_.ci, at.internal_shape.real());
  else
    stiffness -= numerics::product(dynamic.value(stiffness_.ci, damping_.ci, mass_.ci), at.internal_shape);
  return stiffness;
}

HarmonicMatrices CondensedModel::stiffness(double omega, const std::vector<CondensedHarmonic>& harmonics) const {
  std::vector<Eigen::MatrixXcd> matrices;
  for (std::size_t j = 0; j < harmonics.size(); ++j) {
    const auto h = static_cast<int>(j);
    if (!shared_) {
      matrices.push_back(stiffness(h, omega, harmonics[j]));
      continue;
    }
    const Eigen::VectorXcd within = Dynamic(h, omega).value(stiffness_.ii, damping_.ii, mass_.ii).col(0);
    matrices.emplace_back((-within(moving_).cwiseInverse()).asDiagonal());
  }
  return shared_ ? HarmonicMatrices(shared_, shared_coupling_, std::move(matrices))
                 : HarmonicMatrices(std::move(matrices));
}

Eigen::VectorXcd CondensedModel::slope(int h, double omega, const CondensedHarmonic& at,
                                       const Eigen::VectorXcd& contact) const {
  if (h == 0) return Eigen::VectorXcd::Zero(contact.size());
  const Dynamic dynamic(h, omega);
  const Eigen::VectorXcd internal = at.internal_force - at.internal_shape * contact;
  Eigen::VectorXcd result = dynamic.slope(damping_.cc, mass_.cc) * contact;
  if (internal.size() == 0) return result;
  const Eigen::MatrixXcd ci = dynamic.slope(damping_.ci, mass_.ci), ii = dynamic.slope(damping_.ii, mass_.ii);
  Eigen::VectorXcd on_internal = ci.transpose() * contact;
  on_internal += modal_ ? Eigen::VectorXcd(ii.col(0).cwiseProduct(internal)) : Eigen::VectorXcd(ii * internal);
  result += ci * internal - at.internal_shape.transpose() * on_internal;
  return result;
}

Eigen::VectorXcd CondensedModel::recover(const CondensedHarmonic& at, const Eigen::VectorXcd& contact) const {
  Eigen::VectorXcd all(n_);
  const Eigen::VectorXcd internal = basis_ * (at.internal_force - at.internal_shape * contact);
  for (std::size_t i = 0; i < contact_dofs_.size(); ++i) all(contact_dofs_[i]) = contact(static_cast<Eigen::Index>(i));
  for (std::size_t i = 0; i < internal_dofs_.size(); ++i)
    all(internal_dofs_[i]) = internal(static_cast<Eigen::Index>(i));
  return all;
}

Eigen::VectorXcd CondensedModel::outputs(const CondensedHarmonic& at, const Eigen::VectorXcd& contact) const {
  return output_contact_ * contact + output_internal_ * (at.internal_force - at.internal_shape * contact);
}

Eigen::MatrixXcd CondensedModel::output_gradient(const CondensedHarmonic& at) const {
  return output_contact_ - output_internal_ * at.internal_shape;
}

Eigen::VectorXcd CondensedModel::output_slope(int h, double omega, const CondensedHarmonic& at,
                                              const Eigen::VectorXcd& contact) const {
  const Dynamic dynamic(h, omega);
  const Eigen::VectorXcd internal = at.internal_force - at.internal_shape * contact;
  if (h == 0 || internal.size() == 0) return Eigen::VectorXcd::Zero(output_contact_.rows());
  const Eigen::MatrixXcd ii_slope = dynamic.slope(damping_.ii, mass_.ii);
  Eigen::VectorXcd rhs = dynamic.slope(damping_.ci, mass_.ci).transpose() * contact;
  rhs += modal_ ? Eigen::VectorXcd(ii_slope.col(0).cwiseProduct(internal)) : Eigen::VectorXcd(ii_slope * internal);
  Status status = Status::converged;
  return -(output_internal_ * solve_internal(dynamic.value(stiffness_.ii, damping_.ii, mass_.ii), rhs, &status).col(0));
}

CondensedModel::HarmonicEnergy CondensedModel::energy(int h, double omega, const CondensedHarmonic& at,
                                                      const Eigen::VectorXcd& contact) const {
  HarmonicEnergy energy;
  if (h == 0) return energy;
  const Eigen::VectorXcd internal = at.internal_force - at.internal_shape * contact;
  // Work per period: pi h (F_c q_s - F_s q_c) = -pi h Im(F^* Q).
  if (h <= force_harmonics())
    energy.input =
        -std::numbers::pi * h * (force_contact_.col(h).dot(contact) + force_internal_.col(h).dot(internal)).imag();
  const Eigen::VectorXcd on_internal = modal_
                                           ? Eigen::VectorXcd(damping_.ii.col(0).cast<Complex>().cwiseProduct(internal))
                                           : Eigen::VectorXcd(damping_.ii * internal);
  const double quadratic = contact.dot(damping_.cc * contact).real() + 2 * contact.dot(damping_.ci * internal).real() +
                           internal.dot(on_internal).real();
  energy.damping = std::numbers::pi * h * h * omega * quadratic;
  return energy;
}

}  // namespace dovetail::dynamics
