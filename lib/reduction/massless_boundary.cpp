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

// X^T M X and X^T M Phi, some columns at once: M X is never there as a whole.
void add_inertia(const FullModel& full, TraceModel& trace) {
  const Eigen::Index contact = trace.field.cols();
  trace.cross_inertia.resize(contact, trace.basis.cols());
  trace.field_inertia.resize(contact, contact);
  constexpr Eigen::Index kColumns = 64;
  using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  for (Eigen::Index first = 0; first < contact; first += kColumns) {
    const Eigen::Index columns = std::min(kColumns, contact - first);
    // Row by row of the symmetric M: it is read once for all columns.
    const Rows some = trace.field.middleCols(first, columns);
    const Eigen::MatrixXd inertia = full.mass.transpose() * some;
    trace.field_inertia.middleCols(first, columns) = numerics::transposed_product(trace.field, inertia);
    trace.cross_inertia.middleRows(first, columns) = numerics::transposed_product(inertia, trace.basis);
  }
}

TraceModel trace_with(const Prepared& prepared, const ReductionOptions& options) {
  const FullModel& full = prepared.full;
  TraceModel result;
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
  RitzBasis basis = rayleigh_ritz(full, vectors);
  result.seconds_modes = seconds_since(start);
  result.first_neglected_eigenvalue = modes.first_neglected;

  start = Clock::now();
  ResidualFlexibility residual = residual_flexibility(prepared.solver, full.mass, basis, modes.soft());
  if (residual.status != Status::converged) {
    result.status = residual.status;
    result.message = "the stiffness is not positive definite on the complement of the kept modes";
    return result;
  }
  result.basis = std::move(basis.vectors);
  result.eigenvalues = std::move(basis.eigenvalues);
  result.field = std::move(residual.field);
  result.flexibility = std::move(residual.contact);
  add_inertia(full, result);
  result.static_force = result.basis.transpose() * full.static_force;
  result.cosine_force = result.basis.transpose() * full.cosine_force;
  result.sine_force = result.basis.transpose() * full.sine_force;
  result.outputs = result.basis.transpose() * full.outputs;
  result.output_names = full.output_names;
  result.contact = full.contact;
  result.seconds_contact_solves += seconds_since(start);
  result.seconds_total = prepared.seconds + result.seconds_modes + seconds_since(start);
  return result;
}

Reduction reduce_with(const Prepared& prepared, const ReductionOptions& options) {
  const TraceModel trace = trace_with(prepared, options);
  Eigen::SparseMatrix<double> same(trace.contact.count(), trace.contact.count());
  same.setIdentity();
  return reduce(trace, same, trace.contact, options.damping_ratio);
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

TraceModel trace_model(const FullModel& full, const ReductionOptions& options) {
  check(full, options);
  return trace_with(Prepared(full), options);
}

Reduction reduce(const TraceModel& trace, const Eigen::SparseMatrix<double>& average, ContactNodes contact,
                 double damping_ratio) {
  const Clock::time_point start = Clock::now();
  Reduction result;
  result.status = trace.status;
  result.message = trace.message;
  result.free_eigenvalues = trace.eigenvalues;
  result.first_neglected_eigenvalue = trace.first_neglected_eigenvalue;
  result.rigid_modes = trace.rigid_modes;
  result.negative_modes = trace.negative_modes;
  result.seconds_factorisation = trace.seconds_factorisation;
  result.seconds_contact_solves = trace.seconds_contact_solves;
  result.seconds_modes = trace.seconds_modes;
  result.seconds_total = trace.seconds_total;
  if (trace.status != Status::converged) return result;

  const Eigen::SparseMatrix<double> a = for_directions(average, contact.directions());
  const Eigen::Index nodal = a.rows(), m = trace.basis.cols();
  const Eigen::MatrixXd flexibility = a * trace.flexibility * a.transpose();
  const Eigen::LLT<Eigen::MatrixXd> g(0.5 * (flexibility + flexibility.transpose()));
  if (g.info() != Eigen::Success || !(g.rcond() > 1e-14)) {
    result.status = Status::singular;
    result.message = "the residual flexibility of the contact is not positive definite: too many modes are kept";
    return result;
  }
  const Eigen::MatrixXd inverse = g.solve(Eigen::MatrixXd::Identity(nodal, nodal));
  const Eigen::MatrixXd free_on_contact = a * trace.basis.bottomRows(a.cols());
  Eigen::MatrixXd glued = free_on_contact.transpose() * g.solve(free_on_contact);
  glued = (0.5 * (glued + glued.transpose())).eval();
  glued.diagonal() += trace.eigenvalues;
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(glued);
  if (m > 0 && !(eigen.eigenvalues()(0) > 0)) {
    result.status = Status::singular;
    result.message = "the glued structure is not positive definite";
    return result;
  }
  // Coordinates [u; q], q rotated to the glued modes.
  const Eigen::MatrixXd& rotation = eigen.eigenvectors();
  result.glued_frequencies = eigen.eigenvalues().cwiseSqrt();
  result.recovery.basis = trace.basis * rotation;
  result.recovery.first = nodal;
  result.recovery.contact_response = -trace.field * a.transpose();

  ReducedModel& model = result.model;
  const Eigen::Index n = nodal + m;
  model.mass = Eigen::MatrixXd::Zero(n, n);
  model.mass.diagonal().tail(m).setOnes();
  model.damping = Eigen::MatrixXd::Zero(n, n);
  model.damping.diagonal().tail(m) = 2 * damping_ratio * result.glued_frequencies;
  model.stiffness = Eigen::MatrixXd::Zero(n, n);
  model.stiffness.topLeftCorner(nodal, nodal) = 0.5 * (inverse + inverse.transpose());
  const Eigen::MatrixXd coupling = -g.solve(free_on_contact * rotation);
  model.stiffness.topRightCorner(nodal, m) = coupling;
  model.stiffness.bottomLeftCorner(m, nodal) = coupling.transpose();
  model.stiffness.diagonal().tail(m) = eigen.eigenvalues();
  model.contact = contact_first(std::move(contact));

  const auto rows_of = [&](const Eigen::MatrixXd& loads) {
    Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(loads.cols(), n);
    rows.rightCols(m) = loads.transpose() * rotation;
    return rows;
  };
  model.static_force = rows_of(trace.static_force).transpose();
  model.cosine_force = rows_of(trace.cosine_force);
  model.sine_force = rows_of(trace.sine_force);
  model.output_vectors = rows_of(trace.outputs);
  model.output_names = trace.output_names;

  // u = Phi q + Psi lambda, Psi = -X A^T, lambda = -K_red[u rows] (u, q): inertia of that field beyond diag(0, I).
  const Eigen::MatrixXd force = model.stiffness.topRows(nodal);  // -lambda of unit coordinates [nc, n]
  const Eigen::MatrixXd field_inertia = a * trace.field_inertia * a.transpose();
  Eigen::MatrixXd neglected = 0.5 * force.transpose() * field_inertia * force;
  neglected.rightCols(m) += force.transpose() * (a * trace.cross_inertia * rotation);
  result.neglected_mass = neglected + neglected.transpose();
  result.frequency_error = 0.5 * result.neglected_mass.diagonal().tail(m);
  result.seconds_total += seconds_since(start);
  return result;
}

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
