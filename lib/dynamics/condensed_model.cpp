#include "dynamics/condensed_model.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "dynamics/params.hpp"
#include "numerics/dense_product.hpp"
#include "numerics/dense_symmetric.hpp"
#include "reduction/contact_order.hpp"
#include "reduction/validation.hpp"

namespace dovetail::dynamics {
namespace {

constexpr CondensationParams kCondensation = {};

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
  if (std::vector<Violation> found = violations(model); !found.empty()) throw InputError(std::move(found));
  n_ = model.size();
  contact_ = model.contact;
  wear_law_ = contact::find_wear_law(contact_.wear_law);
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
  const double rounding = kCondensation.massless * model.mass.cwiseAbs().maxCoeff();
  massless_contact_ = (mass_.cc.size() == 0 || mass_.cc.cwiseAbs().maxCoeff() <= rounding) &&
                      (mass_.ci.size() == 0 || mass_.ci.cwiseAbs().maxCoeff() <= rounding);
  diagonalise();
  share_static_stiffness();

  Eigen::MatrixXcd force = Eigen::MatrixXcd::Zero(n_, model.cosine_force.rows() + 1);
  force.col(0).real() = model.static_force;
  for (Eigen::Index j = 0; j < model.cosine_force.rows(); ++j) {
    force.col(j + 1).real() = model.cosine_force.row(j);
    force.col(j + 1).imag() = -model.sine_force.row(j);
  }
  force_contact_ = force(contact_dofs_, Eigen::all);
  const Eigen::MatrixXcd on_internal = force(internal_dofs_, Eigen::all);
  force_internal_.resize(basis_.cols(), on_internal.cols());
  force_internal_.real() = numerics::transposed_product(basis_, on_internal.real());
  force_internal_.imag() = numerics::transposed_product(basis_, on_internal.imag());
  const Eigen::MatrixXd outputs =
      model.output_vectors.rows() > 0 ? model.output_vectors : Eigen::MatrixXd(Eigen::MatrixXd::Zero(0, n_));
  output_contact_ = outputs(Eigen::all, contact_dofs_);
  output_internal_ = numerics::product(outputs(Eigen::all, internal_dofs_), basis_);
}

contact::WearNode CondensedModel::wear_node(Eigen::Index node) const {
  return {.area = contact_.area(node),
          .friction = contact_.friction(node),
          .law = {.coefficient = contact_.wear_coefficient(node),
                  .threshold = contact_.wear_threshold.size() > 0 ? contact_.wear_threshold(node) : 0}};
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
  const bool already = m.isDiagonal(kCondensation.diagonal) && c.isDiagonal(kCondensation.diagonal) &&
                       k.isDiagonal(kCondensation.diagonal);
  if (!already) {
    // Both the mass and the stiffness metric may be singular; the first that is definite serves.
    const bool by_mass = numerics::DenseCholesky(m).reciprocal_condition() > kCondensation.mass_metric;
    const bool by_stiffness =
        !by_mass && numerics::DenseCholesky(k).reciprocal_condition() > kCondensation.stiffness_metric;
    if (by_mass || by_stiffness) {
      const numerics::SymmetricPairs pairs = numerics::all_pairs<double>(by_mass ? k : m, by_mass ? m : k);
      if (pairs.status == Status::converged) basis_ = pairs.vectors;
    }
    const Eigen::MatrixXd damping = numerics::congruent(c, basis_);
    const Eigen::VectorXd scale = damping.diagonal().cwiseAbs();
    modal_ = (by_mass || by_stiffness) && is_diagonal(damping, scale, kCondensation.modal_damping);
    set_glued_frequencies(numerics::congruent(m, basis_), numerics::congruent(k, basis_));
    if (!modal_) basis_ = Eigen::MatrixXd::Identity(ni, ni);
  } else {
    set_glued_frequencies(m, k);
  }
  for (Partition* part : {&mass_, &damping_, &stiffness_}) {
    part->ci = numerics::product(part->ci, basis_);
    part->ii = numerics::congruent(part->ii, basis_);
    if (modal_) part->ii = part->ii.diagonal().eval();
  }
  subtract_massless_coordinates();
}

// Coordinates without mass follow statically however high the harmonic (unless they are damped).
void CondensedModel::subtract_massless_coordinates() {
  if (modal_) {
    const double limit = kCondensation.massless * mass_.ii.maxCoeff();
    for (Eigen::Index j = 0; j < mass_.ii.rows(); ++j)
      if (mass_.ii(j, 0) <= limit && stiffness_.ii(j, 0) > 0)
        local_stiffness_ -= stiffness_.ci.col(j).cwiseAbs2() / stiffness_.ii(j, 0);
    return;
  }
  if (numerics::DenseCholesky(mass_.ii).reciprocal_condition() > kCondensation.mass_metric) return;
  const numerics::SymmetricPairs mass = numerics::all_pairs<double>(mass_.ii);
  if (mass.status != Status::converged) return;
  const Eigen::VectorXd& values = mass.values;
  const Eigen::Index count = (values.array() <= kCondensation.massless * values.cwiseAbs().maxCoeff()).count();
  const Eigen::MatrixXd massless = mass.vectors.leftCols(count);  // ascending eigenvalues
  const numerics::DenseCholesky stiffness(numerics::congruent(stiffness_.ii, massless));
  if (count == 0 || stiffness.status() != Status::converged) return;
  const Eigen::MatrixXd coupling = numerics::transposed_product(massless, stiffness_.ci.transpose());
  local_stiffness_ -= coupling.cwiseProduct(stiffness.solve(coupling)).colwise().sum().transpose();
}

// Springs within that have neither mass nor damping belong to what is static, too. They may be far stiffer than what
// they hold, and are taken out once: in every product what is left of the difference would be rounded anew.
void CondensedModel::share_static_stiffness() {
  const auto none = [](const Partition& part) { return part.cc.isZero(0) && part.ci.isZero(0); };
  if (!modal_ || !none(mass_) || !none(damping_)) return;
  const double limit = kCondensation.massless * (mass_.ii.size() > 0 ? mass_.ii.maxCoeff() : 0);
  std::vector<Eigen::Index> springs;
  for (Eigen::Index j = 0; j < mass_.ii.rows(); ++j) {
    const bool spring = mass_.ii(j, 0) <= limit && damping_.ii(j, 0) == 0 && stiffness_.ii(j, 0) > 0;
    (spring ? springs : moving_).push_back(j);
  }
  Eigen::MatrixXd base = stiffness_.cc;
  if (!springs.empty()) {
    const Eigen::MatrixXd across = stiffness_.ci(Eigen::all, springs);
    const Eigen::VectorXd give = stiffness_.ii.col(0)(springs).cwiseInverse();
    base -= numerics::product(across, give.asDiagonal() * across.transpose());
  }
  shared_ = std::make_shared<const Eigen::MatrixXd>(std::move(base));
  shared_coupling_ = std::make_shared<const Eigen::MatrixXd>(stiffness_.ci(Eigen::all, moving_));
}

void CondensedModel::set_glued_frequencies(const Eigen::MatrixXd& mass, const Eigen::MatrixXd& stiffness) {
  std::vector<double> found;
  const double smallest = kCondensation.massless * mass.diagonal().maxCoeff();
  for (Eigen::Index j = 0; j < mass.rows(); ++j)
    if (mass(j, j) > smallest && stiffness(j, j) >= 0) found.push_back(std::sqrt(stiffness(j, j) / mass(j, j)));
  std::sort(found.begin(), found.end());
  glued_frequencies_ = Eigen::Map<Eigen::VectorXd>(found.data(), static_cast<Eigen::Index>(found.size()));
}

Eigen::VectorXd CondensedModel::glued_frequencies() const {
  return glued_frequencies_;
}

}  // namespace dovetail::dynamics
