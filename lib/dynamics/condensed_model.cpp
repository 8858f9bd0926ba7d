#include "dynamics/condensed_model.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

#include "dynamics/contact_model_check.hpp"
#include "numerics/dense_product.hpp"
#include "reduction/contact_order.hpp"

namespace dovetail::dynamics {
namespace {

using Complex = std::complex<double>;

Eigen::MatrixXd symmetric(const Eigen::MatrixXd& matrix) {
  return (matrix + matrix.transpose()) / 2;
}

bool is_diagonal(const Eigen::MatrixXd& matrix, const Eigen::VectorXd& scale, double tolerance) {
  for (Eigen::Index j = 0; j < matrix.cols(); ++j)
    for (Eigen::Index i = 0; i < matrix.rows(); ++i)
      if (i != j && std::abs(matrix(i, j)) > tolerance * std::sqrt(scale(i) * scale(j))) return false;
  return true;
}

}  // namespace

CondensedModel::CondensedModel(const reduction::ReducedModel& model) {
  check(model);
  n_ = model.size();
  contact_ = model.contact;
  wear_law_ = contact::find_wear_law(contact_.wear_law);
  if (contact_.wear_threshold.size() == 0) contact_.wear_threshold = Eigen::VectorXd::Zero(nodes());
  if (contact_.slip_origin.size() == 0)
    contact_.slip_origin = Eigen::MatrixXd::Zero(nodes(), contact_.tangential.cols());
  output_names_ = model.output_names;
  std::vector<char> is_contact(static_cast<std::size_t>(n_), 0);
  for (Eigen::Index i = 0; i < nodes(); ++i) {
    contact_dofs_.push_back(contact_.normal(i));
    for (Eigen::Index r = 0; r < contact_.tangential.cols(); ++r) contact_dofs_.push_back(contact_.tangential(i, r));
  }
  for (Eigen::Index dof : contact_dofs_) is_contact[static_cast<std::size_t>(dof)] = 1;
  for (Eigen::Index dof = 0; dof < n_; ++dof)
    if (!is_contact[static_cast<std::size_t>(dof)]) internal_dofs_.push_back(dof);
  const auto split = [&](const Eigen::MatrixXd& matrix) {
    const Eigen::MatrixXd s = symmetric(matrix);
    return Partition{.cc = s(contact_dofs_, contact_dofs_),
                     .ci = s(contact_dofs_, internal_dofs_),
                     .ii = s(internal_dofs_, internal_dofs_)};
  };
  mass_ = split(model.mass);
  damping_ = split(model.damping);
  stiffness_ = split(model.stiffness);
  const double rounding = 1e-13 * model.mass.cwiseAbs().maxCoeff();
  massless_contact_ = (mass_.cc.size() == 0 || mass_.cc.cwiseAbs().maxCoeff() <= rounding) &&
                      (mass_.ci.size() == 0 || mass_.ci.cwiseAbs().maxCoeff() <= rounding);
  diagonalise();

  const Eigen::Index harmonics = std::max(model.cosine_force.rows(), model.sine_force.rows());
  Eigen::MatrixXcd force = Eigen::MatrixXcd::Zero(n_, harmonics + 1);
  force.col(0).real() = model.static_force;
  for (Eigen::Index j = 0; j < model.cosine_force.rows(); ++j) force.col(j + 1).real() = model.cosine_force.row(j);
  for (Eigen::Index j = 0; j < model.sine_force.rows(); ++j) force.col(j + 1).imag() = -model.sine_force.row(j);
  force_contact_ = force(contact_dofs_, Eigen::all);
  force_internal_ = basis_.transpose() * Eigen::MatrixXcd(force(internal_dofs_, Eigen::all));
  const Eigen::MatrixXd outputs =
      model.output_vectors.rows() > 0 ? model.output_vectors : Eigen::MatrixXd(Eigen::MatrixXd::Zero(0, n_));
  output_contact_ = outputs(Eigen::all, contact_dofs_);
  output_internal_ = Eigen::MatrixXd(outputs(Eigen::all, internal_dofs_)) * basis_;
}

contact::WearNode CondensedModel::wear_node(Eigen::Index node) const {
  return {.area = contact_.area(node),
          .friction = contact_.friction(node),
          .coefficient = contact_.wear_coefficient(node),
          .threshold = contact_.wear_threshold(node)};
}

reduction::ReducedModel CondensedModel::reduced() const {
  const Eigen::Index nc = contact_size(), ni = force_internal_.rows(), n = nc + ni;
  const auto joined = [&](const Partition& part) {
    Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(n, n);
    matrix.topLeftCorner(nc, nc) = part.cc;
    matrix.topRightCorner(nc, ni) = part.ci;
    matrix.bottomLeftCorner(ni, nc) = part.ci.transpose();
    if (modal_)
      matrix.diagonal().tail(ni) = part.ii.col(0);
    else
      matrix.bottomRightCorner(ni, ni) = part.ii;
    return matrix;
  };
  reduction::ReducedModel model;
  model.mass = joined(mass_);
  model.damping = joined(damping_);
  model.stiffness = joined(stiffness_);
  model.contact = reduction::contact_first(contact_);
  Eigen::MatrixXcd force(n, force_contact_.cols());
  force << force_contact_, force_internal_;
  model.static_force = force.col(0).real();
  model.cosine_force = force.rightCols(force_harmonics()).real().transpose();
  model.sine_force = -force.rightCols(force_harmonics()).imag().transpose();
  model.output_vectors.resize(output_contact_.rows(), n);
  model.output_vectors << output_contact_, output_internal_;
  model.output_names = output_names_;
  return model;
}

// Internal coordinates in which M, C and K are diagonal, if there are any; and the local contact stiffness.
void CondensedModel::diagonalise() {
  const auto ni = static_cast<Eigen::Index>(internal_dofs_.size());
  basis_ = Eigen::MatrixXd::Identity(ni, ni);
  local_stiffness_ = stiffness_.cc.diagonal();
  modal_ = true;
  if (ni == 0) {
    for (Partition* part : {&mass_, &damping_, &stiffness_}) part->ii.resize(0, 1);
    return;
  }
  const Eigen::MatrixXd& m = mass_.ii;
  const Eigen::MatrixXd& c = damping_.ii;
  const Eigen::MatrixXd& k = stiffness_.ii;
  const bool already = m.isDiagonal(1e-14) && c.isDiagonal(1e-14) && k.isDiagonal(1e-14);
  if (!already) {
    // Both the mass and the stiffness metric may be singular; the first that is definite serves.
    const Eigen::LLT<Eigen::MatrixXd> mass_factor(m), stiffness_factor(k);
    const bool by_mass = mass_factor.info() == Eigen::Success && mass_factor.rcond() > 1e-12;
    const bool by_stiffness = !by_mass && stiffness_factor.info() == Eigen::Success && stiffness_factor.rcond() > 1e-14;
    if (by_mass || by_stiffness) {
      const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> solver(by_mass ? k : m, by_mass ? m : k);
      if (solver.info() == Eigen::Success) basis_ = solver.eigenvectors();
    }
    const Eigen::MatrixXd damping = basis_.transpose() * c * basis_;
    const Eigen::VectorXd scale = damping.diagonal().cwiseAbs();
    modal_ = (by_mass || by_stiffness) && is_diagonal(damping, scale, 1e-9);
    set_glued_frequencies(basis_.transpose() * m * basis_, basis_.transpose() * k * basis_);
    if (!modal_) basis_ = Eigen::MatrixXd::Identity(ni, ni);
  } else {
    set_glued_frequencies(m, k);
  }
  for (Partition* part : {&mass_, &damping_, &stiffness_}) {
    part->ci = part->ci * basis_;
    const Eigen::MatrixXd internal = basis_.transpose() * part->ii * basis_;
    if (modal_)
      part->ii = internal.diagonal();
    else
      part->ii = internal;
  }
  subtract_massless_coordinates();
}

// Coordinates without mass follow statically however high the harmonic (unless they are damped).
void CondensedModel::subtract_massless_coordinates() {
  if (modal_) {
    const double limit = 1e-13 * mass_.ii.maxCoeff();
    for (Eigen::Index j = 0; j < mass_.ii.rows(); ++j)
      if (mass_.ii(j, 0) <= limit && stiffness_.ii(j, 0) > 0)
        local_stiffness_ -= stiffness_.ci.col(j).cwiseAbs2() / stiffness_.ii(j, 0);
    return;
  }
  const Eigen::LLT<Eigen::MatrixXd> definite(mass_.ii);
  if (definite.info() == Eigen::Success && definite.rcond() > 1e-12) return;
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> mass(mass_.ii);
  const Eigen::VectorXd& values = mass.eigenvalues();
  const Eigen::Index count = (values.array() <= 1e-13 * values.cwiseAbs().maxCoeff()).count();
  const Eigen::MatrixXd massless = mass.eigenvectors().leftCols(count);  // ascending eigenvalues
  const Eigen::LLT<Eigen::MatrixXd> stiffness(massless.transpose() * stiffness_.ii * massless);
  if (count == 0 || stiffness.info() != Eigen::Success) return;
  const Eigen::MatrixXd coupling = massless.transpose() * stiffness_.ci.transpose();
  local_stiffness_ -= coupling.cwiseProduct(stiffness.solve(coupling)).colwise().sum().transpose();
}

void CondensedModel::set_glued_frequencies(const Eigen::MatrixXd& mass, const Eigen::MatrixXd& stiffness) {
  std::vector<double> found;
  const double smallest = 1e-13 * mass.diagonal().maxCoeff();
  for (Eigen::Index j = 0; j < mass.rows(); ++j)
    if (mass(j, j) > smallest && stiffness(j, j) >= 0) found.push_back(std::sqrt(stiffness(j, j) / mass(j, j)));
  std::sort(found.begin(), found.end());
  glued_frequencies_ = Eigen::Map<Eigen::VectorXd>(found.data(), static_cast<Eigen::Index>(found.size()));
}

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
  const Eigen::PartialPivLU<Eigen::MatrixXcd> lu(internal);
  if (!(lu.rcond() > 1e-16)) *status = Status::singular;
  return lu.solve(rhs);
}

HarmonicStiffness CondensedModel::harmonic(int h, double omega, double static_scale) const {
  HarmonicStiffness at;
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
  at.stiffness = dynamic.value(stiffness_.cc, damping_.cc, mass_.cc);
  if (ci.cols() > 0) {
    if (h == 0)
      at.stiffness.real().noalias() -= ci.real() * at.internal_shape.real();
    else
      at.stiffness -= numerics::product(ci, at.internal_shape);
  }
  at.force -= ci * at.internal_force;
  return at;
}

Eigen::VectorXcd CondensedModel::slope(int h, double omega, const HarmonicStiffness& at,
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

Eigen::VectorXcd CondensedModel::recover(const HarmonicStiffness& at, const Eigen::VectorXcd& contact) const {
  Eigen::VectorXcd all(n_);
  const Eigen::VectorXcd internal = basis_ * (at.internal_force - at.internal_shape * contact);
  for (std::size_t i = 0; i < contact_dofs_.size(); ++i) all(contact_dofs_[i]) = contact(static_cast<Eigen::Index>(i));
  for (std::size_t i = 0; i < internal_dofs_.size(); ++i)
    all(internal_dofs_[i]) = internal(static_cast<Eigen::Index>(i));
  return all;
}

Eigen::VectorXcd CondensedModel::outputs(const HarmonicStiffness& at, const Eigen::VectorXcd& contact) const {
  return output_contact_ * contact + output_internal_ * (at.internal_force - at.internal_shape * contact);
}

Eigen::MatrixXcd CondensedModel::output_gradient(const HarmonicStiffness& at) const {
  return output_contact_ - output_internal_ * at.internal_shape;
}

Eigen::VectorXcd CondensedModel::output_slope(int h, double omega, const HarmonicStiffness& at,
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

CondensedModel::HarmonicEnergy CondensedModel::energy(int h, double omega, const HarmonicStiffness& at,
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

Eigen::VectorXd CondensedModel::glued_frequencies() const {
  return glued_frequencies_;
}

}  // namespace dovetail::dynamics
