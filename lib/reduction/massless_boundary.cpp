#include "reduction/massless_boundary.hpp"

#include <chrono>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

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

using Sparse = Eigen::SparseMatrix<double>;

Eigen::MatrixXd symmetric(const Eigen::MatrixXd& matrix) {
  return 0.5 * (matrix + matrix.transpose());
}

/// Lambda + Phi_r^T G^-1 Phi_r [m, m]; `forces` = -G^-1 Phi_r hold the contact where it is.
Eigen::MatrixXd glued_stiffness(const RitzBasis& basis, const Eigen::MatrixXd& on_contact,
                                const Eigen::MatrixXd& forces) {
  Eigen::MatrixXd glued = -symmetric(numerics::transposed_product(on_contact, forces));
  glued.diagonal() += basis.eigenvalues;
  return glued;
}

/// The stiffness of a trace in displacements u of contact nodes, whose flexibility is G, and coordinates q of the
/// basis, which moves them by Phi_r in a free structure.
struct Blocks {
  Eigen::MatrixXd contact;   ///< G^-1 [nc, nc]
  Eigen::MatrixXd coupling;  ///< -G^-1 Phi_r [nc, m]
  Eigen::MatrixXd glued;     ///< Lambda + Phi_r^T G^-1 Phi_r [m, m]

  Blocks(const RitzBasis& basis, const numerics::DenseCholesky& flexibility, const Eigen::MatrixXd& on_contact)
      : contact(symmetric(flexibility.solve(Eigen::MatrixXd::Identity(on_contact.rows(), on_contact.rows())))),
        coupling(-flexibility.solve(on_contact)),
        glued(glued_stiffness(basis, on_contact, coupling)) {}

  /// Adds Psi^T D Psi, with the fields of unit coordinates Psi = [X A^T, Phi] [[G^-1, -G^-1 Phi_r], [0, I]].
  void add(const StiffnessChange& change, const Sparse& average) {
    const Eigen::Index nc = contact.rows(), m = coupling.cols();
    Eigen::MatrixXd coordinates = Eigen::MatrixXd::Identity(nc + m, nc + m);
    coordinates.topRows(nc) << contact, coupling;
    const Eigen::MatrixXd added = symmetric(
        numerics::transposed_product(coordinates, numerics::product(change.on_contact(average), coordinates)));
    contact += added.topLeftCorner(nc, nc);
    coupling += added.topRightCorner(nc, m);
    glued += added.bottomRightCorner(m, m);
  }
};

/// Mass, damping and stiffness in contact displacements and glued modes: `modes` are pairs of the glued stiffness.
ReducedModel in_glued_modes(const Blocks& blocks, const numerics::SymmetricPairs& modes, double damping_ratio) {
  const Eigen::Index contact = blocks.contact.rows(), m = modes.values.size(), n = contact + m;
  ReducedModel model;
  model.mass = Eigen::MatrixXd::Zero(n, n);
  model.mass.diagonal().tail(m).setOnes();
  model.damping = Eigen::MatrixXd::Zero(n, n);
  model.damping.diagonal().tail(m) = 2 * damping_ratio * modes.values.cwiseSqrt();
  model.stiffness = Eigen::MatrixXd::Zero(n, n);
  model.stiffness.topLeftCorner(contact, contact) = blocks.contact;
  const Eigen::MatrixXd coupling = numerics::product(blocks.coupling, modes.vectors);
  model.stiffness.topRightCorner(contact, m) = coupling;
  model.stiffness.bottomLeftCorner(m, contact) = coupling.transpose();
  model.stiffness.diagonal().tail(m) = modes.values;
  return model;
}

}  // namespace

Eigen::VectorXd glued_frequencies(const TraceModel& trace) {
  const ResidualFlexibility& structure = *trace.structure;
  const RitzBasis& basis = structure.basis();
  const Eigen::Index contact = structure.on_contact().rows(), m = basis.vectors.cols();
  Eigen::VectorXd unknown = Eigen::VectorXd::Constant(m, kUnknown);
  const numerics::DenseCholesky g(structure.on_contact());
  if (g.status() != Status::converged) return unknown;
  const Eigen::MatrixXd on_contact = basis.vectors.bottomRows(contact);
  const Eigen::MatrixXd forces = -g.solve(on_contact);
  Eigen::MatrixXd glued = glued_stiffness(basis, on_contact, forces);
  if (trace.change) {
    Eigen::MatrixXd coordinates(contact + m, m);
    coordinates << forces, Eigen::MatrixXd::Identity(m, m);
    glued +=
        symmetric(numerics::transposed_product(coordinates, numerics::product(trace.change->on_trace, coordinates)));
  }
  const numerics::SymmetricPairs pairs = numerics::all_values<double>(glued);
  if (pairs.status != Status::converged) return unknown;
  return pairs.values.cwiseMax(0.0).cwiseSqrt();
}

TraceModel trace_model(const FullModel& full, const ReductionOptions& options, const Factor& known) {
  check(full, options);
  TraceModel result;
  Clock::time_point start = Clock::now();
  Factor stiffness = known;
  Status factorised = Status::converged;
  if (!stiffness) {
    const auto own = std::make_shared<numerics::PartialCholesky>();
    factorised = own->factorise(full.stiffness, full.contact_size(), full.order.get());
    stiffness = own;
  }
  result.seconds_factorisation = lap(start);
  if (factorised != Status::converged)
    return failed(std::move(result), factorised, "the stiffness with the contact held is not positive definite");
  std::optional<FloatingInverse> held(std::in_place, *stiffness, full.mass);
  const FloatingInverse& inverse = *held;
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
  RitzBasis basis = rayleigh_ritz(full.stiffness, full.mass, vectors);
  result.seconds_modes = lap(start);
  if (basis.vectors.cols() < vectors.cols())
    return failed(std::move(result), Status::singular, "the kept modes and static responses are not independent");
  result.first_neglected_eigenvalue = modes.first_neglected;
  held.reset();  // a matrix of the contact's size

  result.structure = std::make_shared<ResidualFlexibility>(stiffness, full.mass, std::move(basis), modes.soft());
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

Reduction reduce(const TraceModel& trace, const Sparse& average, ContactNodes contact, double damping_ratio) {
  Reduction result;
  static_cast<ModesRecord&>(result) = trace;
  if (trace.status != Status::converged) return result;

  const RitzBasis& basis = trace.structure->basis();
  result.free_eigenvalues = basis.eigenvalues;
  const Sparse a = for_directions(average, contact.directions());
  const numerics::DenseCholesky g(symmetric(a * trace.structure->on_contact() * a.transpose()));
  if (!(g.reciprocal_condition() > FlexibilityParams{}.singular)) {
    result.status = Status::singular;
    result.message = "the residual flexibility of the contact is not positive definite: too many modes are kept";
    return result;
  }
  Blocks blocks(basis, g, a * basis.vectors.bottomRows(a.cols()));
  if (trace.change) blocks.add(*trace.change, a);
  const numerics::SymmetricPairs glued = numerics::all_pairs<double>(blocks.glued);
  if (glued.status != Status::converged || (basis.vectors.cols() > 0 && !(glued.values(0) > 0))) {
    result.status = Status::singular;
    result.message = "the glued structure is not positive definite";
    return result;
  }
  // Coordinates [u; q], q rotated to the glued modes.
  const Eigen::MatrixXd& rotation = glued.vectors;
  result.glued_frequencies = glued.values.cwiseSqrt();
  using Columns = Recovery::Columns;
  result.recovery.linear = [structure = trace.structure, change = trace.change, rotation, a](const Columns& q,
                                                                                             const Columns& lambda) {
    const Eigen::MatrixXd force = lambda.size() > 0 ? Eigen::MatrixXd(-a.transpose() * lambda) : Eigen::MatrixXd();
    Eigen::MatrixXd field = structure->field(numerics::product(rotation, q.bottomRows(rotation.rows())), force);
    if (change) field -= structure->response(change->whole * field);
    return field;
  };
  result.model = in_glued_modes(blocks, glued, damping_ratio);
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
  Sparse same(trace.contact.count(), trace.contact.count());
  same.setIdentity();
  return reduce(trace, same, trace.contact, options.damping_ratio);
}

}  // namespace dovetail::reduction
