#include "reduction/massless_boundary.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <optional>
#include <utility>

#include "numerics/dense_product.hpp"
#include "reduction/accuracy.hpp"
#include "reduction/boundary_basis.hpp"
#include "reduction/contact_order.hpp"
#include "reduction/contact_solver.hpp"
#include "reduction/free_modes.hpp"
#include "reduction/validation.hpp"

namespace dovetail {

template <>
std::span<const Field<reduction::ReductionOptions>> option_table<reduction::ReductionOptions>() {
  using Options = reduction::ReductionOptions;
  static const std::array table{
      Field<Options>{.key = "modes",
                     .member = &Options::modes,
                     .range = kNonNegative,
                     .help = "Free-interface modes kept, rigid ones included."},
      Field<Options>{.key = "damping_ratio",
                     .member = &Options::damping_ratio,
                     .range = kNonNegative,
                     .help = "Modal damping of the glued modes, as a fraction of critical."},
      Field<Options>{.key = "eigen_tolerance",
                     .member = &Options::eigen_tolerance,
                     .range = {.lower = 0, .upper = 1, .lower_open = true, .upper_open = true},
                     .help = "Relative accuracy of the free-interface modes."},
  };
  return table;
}

}  // namespace dovetail

namespace dovetail::reduction {

namespace {

using Clock = std::chrono::steady_clock;
double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

// Everything that does not depend on the number of modes.
struct Prepared {
  const FullModel& full;
  ContactSolver solver;
  std::optional<FloatingInverse> inverse;
  Status status = Status::converged;
  double seconds = 0;

  explicit Prepared(const FullModel& model) : full(model) {
    const Clock::time_point start = Clock::now();
    status = solver.factorise(full.stiffness, full.contact_size());
    if (status == Status::converged) inverse.emplace(solver, full.mass);
    seconds = seconds_since(start);
  }
};

void check(const FullModel& full, const ReductionOptions& options) {
  std::vector<Violation> found = violations(full);
  const std::vector<Violation> wrong_options = dovetail::violations(options, "reduction");
  found.insert(found.end(), wrong_options.begin(), wrong_options.end());
  if (!found.empty()) throw InputError(found);
}

// Coordinates [r; q], q rotated to the glued modes.
bool assemble(const FullModel& full, const RitzBasis& basis, ResidualFlexibility residual, double damping_ratio,
              Reduction& result) {
  const Eigen::Index contact = full.contact_size();
  const Eigen::Index m = basis.vectors.cols();
  const Eigen::LLT<Eigen::MatrixXd> g(residual.contact);
  if (g.info() != Eigen::Success || !(g.rcond() > 1e-14)) {
    result.status = Status::singular;
    result.message = "the residual flexibility of the contact is not positive definite: too many modes are kept";
    return false;
  }
  const Eigen::MatrixXd inverse = g.solve(Eigen::MatrixXd::Identity(contact, contact));
  const Eigen::MatrixXd on_contact = basis.vectors.bottomRows(contact);
  Eigen::MatrixXd glued = on_contact.transpose() * g.solve(on_contact);
  glued = (0.5 * (glued + glued.transpose())).eval();
  glued.diagonal() += basis.eigenvalues;
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(glued);
  if (m > 0 && !(eigen.eigenvalues()(0) > 0)) {
    result.status = Status::singular;
    result.message = "the glued structure is not positive definite";
    return false;
  }
  result.glued_frequencies = eigen.eigenvalues().cwiseSqrt();
  result.recovery.basis = basis.vectors * eigen.eigenvectors();
  result.recovery.first = contact;
  result.recovery.contact_response = std::move(residual.field);
  result.recovery.contact_response *= -1;
  const Eigen::MatrixXd& phi = result.recovery.basis;

  ReducedModel& model = result.model;
  const Eigen::Index n = contact + m;
  model.mass = Eigen::MatrixXd::Zero(n, n);
  model.mass.diagonal().tail(m).setOnes();
  model.damping = Eigen::MatrixXd::Zero(n, n);
  model.damping.diagonal().tail(m) = 2 * damping_ratio * result.glued_frequencies;
  model.stiffness = Eigen::MatrixXd::Zero(n, n);
  model.stiffness.topLeftCorner(contact, contact) = 0.5 * (inverse + inverse.transpose());
  const Eigen::MatrixXd coupling = -g.solve(phi.bottomRows(contact));
  model.stiffness.topRightCorner(contact, m) = coupling;
  model.stiffness.bottomLeftCorner(m, contact) = coupling.transpose();
  model.stiffness.diagonal().tail(m) = eigen.eigenvalues();
  model.contact = contact_first(full.contact);

  const auto project = [&](const Eigen::MatrixXd& loads) {
    Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(loads.cols(), n);
    rows.rightCols(m) = loads.transpose() * phi;
    return rows;
  };
  model.static_force = project(full.static_force).transpose();
  model.cosine_force = project(full.cosine_force);
  model.sine_force = project(full.sine_force);
  model.output_vectors = project(full.outputs);
  model.output_names = full.output_names;

  // u = Phi q + Psi lambda, lambda = -K_red[r rows] (r, q): inertia of that field beyond diag(0, I).
  const Eigen::MatrixXd& psi = result.recovery.contact_response;
  const Eigen::MatrixXd force = model.stiffness.topRows(contact);  // -lambda of unit coordinates [nc, n]
  Eigen::MatrixXd phi_inertia(contact, m);                         // Psi^T M Phi
  Eigen::MatrixXd psi_inertia(contact, contact);                   // Psi^T M Psi
  constexpr Eigen::Index kColumns = 64;                            // at once: M Psi is never there as a whole
  using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  for (Eigen::Index first = 0; first < contact; first += kColumns) {
    const Eigen::Index columns = std::min(kColumns, contact - first);
    // Row by row of the symmetric M: it is read once for all columns.
    const Rows some = psi.middleCols(first, columns);
    const Eigen::MatrixXd inertia = full.mass.transpose() * some;
    psi_inertia.middleCols(first, columns) = numerics::transposed_product(psi, inertia);
    phi_inertia.middleRows(first, columns) = numerics::transposed_product(inertia, phi);
  }
  Eigen::MatrixXd neglected = 0.5 * force.transpose() * psi_inertia * force;
  neglected.rightCols(m) -= force.transpose() * phi_inertia;
  result.neglected_mass = neglected + neglected.transpose();
  result.frequency_error = 0.5 * result.neglected_mass.diagonal().tail(m);
  return true;
}

Reduction reduce_with(const Prepared& prepared, const ReductionOptions& options) {
  const FullModel& full = prepared.full;
  Reduction result;
  result.status = prepared.status;
  result.seconds_factorisation = prepared.solver.seconds_factorisation();
  result.seconds_contact_solves = prepared.seconds - result.seconds_factorisation;
  if (prepared.status != Status::converged) {
    result.message = "the stiffness with the contact held is not positive definite";
    return result;
  }
  const FloatingInverse& inverse = *prepared.inverse;
  result.rigid_modes = static_cast<int>(inverse.rigid_modes().cols());
  result.negative_modes = inverse.negative();

  Clock::time_point start = Clock::now();
  // The contact flexibility needs as many directions outside the basis as there are contact dofs.
  const Eigen::Index limit = full.internal_size();
  const FreeModes modes = free_modes(inverse, options.modes, limit, options.eigen_tolerance);
  if (modes.status != Status::converged) {
    result.status = modes.status;
    result.message = "the free-interface modes did not converge";
    return result;
  }
  const Eigen::MatrixXd responses = static_responses(full, inverse, modes, limit - modes.vectors.cols());
  Eigen::MatrixXd vectors(full.size(), modes.vectors.cols() + responses.cols());
  vectors << modes.vectors, responses;
  const RitzBasis basis = rayleigh_ritz(full, vectors);
  result.seconds_modes = seconds_since(start);
  result.free_eigenvalues = basis.eigenvalues;
  result.first_neglected_eigenvalue = modes.first_neglected;

  start = Clock::now();
  ResidualFlexibility residual = residual_flexibility(prepared.solver, full.mass, basis, modes.soft());
  if (residual.status != Status::converged) {
    result.status = residual.status;
    result.message = "the stiffness is not positive definite on the complement of the kept modes";
    return result;
  }
  assemble(full, basis, std::move(residual), options.damping_ratio, result);
  result.seconds_contact_solves += seconds_since(start);
  result.seconds_total = prepared.seconds + result.seconds_modes + seconds_since(start);
  return result;
}

// The error of Z is not part of it: most of that is the inertia around the contact nodes, which is dropped
// on purpose and hardly changes with the number of modes.
double worst_error(const Reduction& reduction, std::span<const double> angular_frequencies) {
  double worst = 0;
  double highest = 0;
  for (double angular_frequency : angular_frequencies) {
    worst = std::max(worst, estimate(reduction, angular_frequency).flexibility);
    highest = std::max(highest, std::abs(angular_frequency));
  }
  for (Eigen::Index k = 0; k < reduction.glued_frequencies.size(); ++k)
    if (k == 0 || reduction.glued_frequencies(k) <= highest)
      worst = std::max(worst, std::abs(reduction.frequency_error(k)));
  return worst;
}

}  // namespace

Reduction reduce(const FullModel& full, const ReductionOptions& options) {
  check(full, options);
  const Prepared prepared(full);
  return reduce_with(prepared, options);
}

Reduction reduce_to_tolerance(const FullModel& full, std::span<const double> angular_frequencies, double tolerance,
                              const ReductionOptions& options) {
  check(full, options);
  if (!(tolerance > 0))
    throw InputError(
        {.file = {}, .line = 0, .key = "tolerance", .value = shortest(tolerance), .allowed = "must be > 0"});
  const Prepared prepared(full);
  ReductionOptions tried = options;
  const int most = static_cast<int>(full.internal_size());
  Reduction best;
  while (true) {
    Reduction reduction = reduce_with(prepared, tried);
    if (reduction.status != Status::converged) {
      if (best.model.size() == 0) return reduction;
      break;  // the earlier one is usable, only not as accurate as asked
    }
    const double worst = worst_error(reduction, angular_frequencies);
    best = std::move(reduction);
    if (worst <= tolerance) return best;
    if (tried.modes >= most) break;
    tried.modes = std::min(most, tried.modes + std::max(4, tried.modes / 2));
  }
  best.status = Status::iteration_limit;
  best.message = "no number of modes reaches the tolerance asked for";
  return best;
}

}  // namespace dovetail::reduction
