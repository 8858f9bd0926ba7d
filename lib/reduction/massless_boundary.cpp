#include "reduction/massless_boundary.hpp"

#include <chrono>
#include <limits>
#include <utility>

#include "numerics/dense_product.hpp"
#include "numerics/dense_symmetric.hpp"
#include "reduction/boundary_basis.hpp"
#include "reduction/contact_order.hpp"
#include "reduction/free_modes.hpp"
#include "reduction/params.hpp"
#include "reduction/validation.hpp"

namespace dovetail {

template <>
std::span<const Field<reduction::ReductionOptions>> option_table<reduction::ReductionOptions>() {
  using O = reduction::ReductionOptions;
  static const std::vector<Field<O>> fields{
      {.key = "modes", .member = &O::modes, .range = kNonNegative},
      {.key = "damping_ratio", .member = &O::damping_ratio, .range = kNonNegative},
      {.key = "eigen_tolerance",
       .member = &O::eigen_tolerance,
       .range = {.lower = 0, .upper = 1, .lower_open = true, .upper_open = true}},
  };
  return fields;
}

}  // namespace dovetail

namespace dovetail::reduction {

namespace {

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
using Clock = std::chrono::steady_clock;
/// Seconds since `start`, which is set to now.
double lap(Clock::time_point& start) {
  const Clock::time_point before = std::exchange(start, Clock::now());
  return std::chrono::duration<double>(start - before).count();
}

void check(const FullModel& full, const ReductionOptions& options) {
  std::vector<Violation> found = violations(full);
  const std::vector<Violation> wrong_options = dovetail::violations(options, "reduction");
  found.insert(found.end(), wrong_options.begin(), wrong_options.end());
  if (!found.empty()) throw InputError(found);
}

TraceModel failed(TraceModel result, Status status, const char* message) {
  result.status = status;
  result.message = message;
  return result;
}

/// Lambda + Phi_r^T G^-1 Phi_r [m, m].
Eigen::MatrixXd glued_stiffness(const RitzBasis& basis, const numerics::DenseCholesky& flexibility,
                                const Eigen::MatrixXd& on_contact) {
  Eigen::MatrixXd glued = numerics::transposed_product(on_contact, flexibility.solve(on_contact));
  glued = (0.5 * (glued + glued.transpose())).eval();
  glued.diagonal() += basis.eigenvalues;
  return glued;
}

/// Mass, damping and stiffness in contact displacements and glued modes of these squared frequencies, which move the
/// contact of the free structure by `on_contact` [nc, m].
ReducedModel in_glued_modes(const numerics::DenseCholesky& flexibility, const Eigen::MatrixXd& on_contact,
                            const Eigen::VectorXd& squares, double damping_ratio) {
  const Eigen::Index contact = on_contact.rows(), modes = on_contact.cols(), n = contact + modes;
  ReducedModel model;
  model.mass = Eigen::MatrixXd::Zero(n, n);
  model.mass.diagonal().tail(modes).setOnes();
  model.damping = Eigen::MatrixXd::Zero(n, n);
  model.damping.diagonal().tail(modes) = 2 * damping_ratio * squares.cwiseSqrt();
  model.stiffness = Eigen::MatrixXd::Zero(n, n);
  const Eigen::MatrixXd inverse = flexibility.solve(Eigen::MatrixXd::Identity(contact, contact));
  model.stiffness.topLeftCorner(contact, contact) = 0.5 * (inverse + inverse.transpose());
  const Eigen::MatrixXd coupling = -flexibility.solve(on_contact);
  model.stiffness.topRightCorner(contact, modes) = coupling;
  model.stiffness.bottomLeftCorner(modes, contact) = coupling.transpose();
  model.stiffness.diagonal().tail(modes) = squares;
  return model;
}

}  // namespace

Eigen::VectorXd glued_frequencies(const TraceModel& trace) {
  const RitzBasis& basis = trace.structure->basis();
  const Eigen::MatrixXd& flexibility = trace.structure->on_contact();
  const Eigen::MatrixXd on_contact = basis.vectors.bottomRows(flexibility.rows());
  const numerics::DenseCholesky g(flexibility);
  const Eigen::Index modes = on_contact.cols();
  if (g.status() != Status::converged) return Eigen::VectorXd::Constant(modes, kUnknown);
  const numerics::SymmetricPairs glued = numerics::all_values<double>(glued_stiffness(basis, g, on_contact));
  if (glued.status != Status::converged) return Eigen::VectorXd::Constant(modes, kUnknown);
  return glued.values.cwiseMax(0.0).cwiseSqrt();
}

TraceModel trace_model(const FullModel& full, const ReductionOptions& options) {
  check(full, options);
  TraceModel result;
  Clock::time_point start = Clock::now();
  const Eigen::SparseMatrix<double> mass = full.mass.pruned();
  const auto stiffness = std::make_shared<numerics::PartialCholesky>();
  const Status factorised = stiffness->factorise(full.stiffness, full.contact_size());
  result.seconds_factorisation = lap(start);
  if (factorised != Status::converged)
    return failed(std::move(result), factorised, "the stiffness with the contact held is not positive definite");
  const FloatingInverse inverse(*stiffness, mass);
  result.seconds_contact_solves = lap(start);
  if (inverse.status() != Status::converged)
    return failed(std::move(result), inverse.status(), "the stiffness could not be inverted on the contact");
  result.rigid_modes = static_cast<int>(inverse.rigid_modes().cols());
  result.negative_modes = inverse.negative();

  // The contact flexibility needs as many directions outside the basis as there are contact dofs.
  const Eigen::Index limit = full.internal_size();
  const FreeModes modes = free_modes(inverse, options.modes, limit, options.eigen_tolerance);
  if (modes.status != Status::converged)
    return failed(std::move(result), modes.status, "the free-interface modes did not converge");
  const Eigen::MatrixXd responses = static_responses(full, inverse, modes, limit - modes.vectors.cols());
  Eigen::MatrixXd vectors(full.size(), modes.vectors.cols() + responses.cols());
  vectors << modes.vectors, responses;
  RitzBasis basis = rayleigh_ritz(full.stiffness, mass, vectors);
  result.seconds_modes = lap(start);
  if (basis.vectors.cols() < vectors.cols())
    return failed(std::move(result), Status::singular, "the kept modes and static responses are not independent");
  result.first_neglected_eigenvalue = modes.first_neglected;

  result.structure = std::make_shared<ResidualFlexibility>(stiffness, mass, std::move(basis), modes.soft());
  result.seconds_contact_solves += lap(start);
  if (const Status status = result.structure->status(); status != Status::converged)
    return failed(std::move(result), status,
                  "the stiffness is not positive definite on the complement of the kept modes");
  const Eigen::MatrixXd& phi = result.structure->basis().vectors;
  result.static_force = phi.transpose() * full.static_force;
  result.cosine_force = numerics::transposed_product(phi, full.cosine_force);
  result.sine_force = numerics::transposed_product(phi, full.sine_force);
  result.outputs = numerics::transposed_product(phi, full.outputs);
  result.output_names = full.output_names;
  result.contact = full.contact;
  return result;
}

Reduction reduce(const TraceModel& trace, const Eigen::SparseMatrix<double>& average, ContactNodes contact,
                 double damping_ratio) {
  Reduction result;
  static_cast<ModesRecord&>(result) = trace;
  if (trace.status != Status::converged) return result;

  const RitzBasis& basis = trace.structure->basis();
  result.free_eigenvalues = basis.eigenvalues;
  const Eigen::SparseMatrix<double> a = for_directions(average, contact.directions());
  const Eigen::MatrixXd flexibility = a * trace.structure->on_contact() * a.transpose();
  const numerics::DenseCholesky g(0.5 * (flexibility + flexibility.transpose()));
  if (!(g.reciprocal_condition() > FlexibilityParams{}.singular)) {
    result.status = Status::singular;
    result.message = "the residual flexibility of the contact is not positive definite: too many modes are kept";
    return result;
  }
  const Eigen::MatrixXd free_on_contact = a * basis.vectors.bottomRows(a.cols());
  const numerics::SymmetricPairs glued = numerics::all_pairs<double>(glued_stiffness(basis, g, free_on_contact));
  if (glued.status != Status::converged || (basis.vectors.cols() > 0 && !(glued.values(0) > 0))) {
    result.status = Status::singular;
    result.message = "the glued structure is not positive definite";
    return result;
  }
  // Coordinates [u; q], q rotated to the glued modes.
  const Eigen::MatrixXd& rotation = glued.vectors;
  result.glued_frequencies = glued.values.cwiseSqrt();
  using Columns = Recovery::Columns;
  result.recovery.linear = [structure = trace.structure, rotation, a](const Columns& q, const Columns& lambda) {
    const Eigen::MatrixXd force = lambda.size() > 0 ? Eigen::MatrixXd(-a.transpose() * lambda) : Eigen::MatrixXd();
    return structure->field(numerics::product(rotation, q.bottomRows(rotation.rows())), force);
  };
  result.model = in_glued_modes(g, numerics::product(free_on_contact, rotation), glued.values, damping_ratio);
  result.model.contact = contact_first(std::move(contact));
  const auto rows_of = [&](const Eigen::MatrixXd& loads) {
    Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(loads.cols(), result.model.size());
    rows.rightCols(rotation.cols()) = numerics::transposed_product(loads, rotation);
    return rows;
  };
  result.model.static_force = rows_of(trace.static_force).transpose();
  result.model.cosine_force = rows_of(trace.cosine_force);
  result.model.sine_force = rows_of(trace.sine_force);
  result.model.output_vectors = rows_of(trace.outputs);
  result.model.output_names = trace.output_names;
  return result;
}

Reduction reduce(const FullModel& full, const ReductionOptions& options) {
  const TraceModel trace = trace_model(full, options);
  Eigen::SparseMatrix<double> same(trace.contact.count(), trace.contact.count());
  same.setIdentity();
  return reduce(trace, same, trace.contact, options.damping_ratio);
}

}  // namespace dovetail::reduction
