#include "reduction/massless_boundary.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <optional>
#include <utility>

#include "reduction/accuracy.hpp"
#include "reduction/boundary_basis.hpp"
#include "reduction/contact_order.hpp"
#include "reduction/free_modes.hpp"
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

using Clock = std::chrono::steady_clock;
double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

// Everything that does not depend on the number of modes.
struct Prepared {
  const FullModel& full;
  std::shared_ptr<const Eigen::SparseMatrix<double>> mass;  // a copy for later, without the zeros it may store
  std::shared_ptr<const numerics::PartialCholesky> stiffness;
  std::optional<FloatingInverse> inverse;
  Status status = Status::converged;
  std::string message;
  double seconds_factorisation = 0, seconds = 0;

  explicit Prepared(const FullModel& model) : full(model) {
    const Clock::time_point start = Clock::now();
    mass = std::make_shared<Eigen::SparseMatrix<double>>(full.mass.pruned());
    auto factor = std::make_shared<numerics::PartialCholesky>();
    status = factor->factorise(full.stiffness, full.contact_size());
    stiffness = factor;
    seconds_factorisation = seconds_since(start);
    if (status == Status::converged) {
      inverse.emplace(*stiffness, *mass);
      status = inverse->status();
      message = "the stiffness could not be inverted on the contact";
    } else {
      message = "the stiffness with the contact held is not positive definite";
    }
    seconds = seconds_since(start);
  }
};

void check(const FullModel& full, const ReductionOptions& options) {
  std::vector<Violation> found = violations(full);
  const std::vector<Violation> wrong_options = dovetail::violations(options, "reduction");
  found.insert(found.end(), wrong_options.begin(), wrong_options.end());
  if (!found.empty()) throw InputError(found);
}

TraceModel trace_with(const Prepared& prepared, const ReductionOptions& options) {
  const FullModel& full = prepared.full;
  TraceModel result;
  result.status = prepared.status;
  result.seconds_factorisation = prepared.seconds_factorisation;
  result.seconds_contact_solves = prepared.seconds - result.seconds_factorisation;
  if (prepared.status != Status::converged) {
    result.message = prepared.message;
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
  RitzBasis basis = rayleigh_ritz(full.stiffness, *prepared.mass, vectors);
  result.seconds_modes = seconds_since(start);
  result.first_neglected_eigenvalue = modes.first_neglected;

  start = Clock::now();
  result.structure =
      std::make_shared<ResidualFlexibility>(prepared.stiffness, *prepared.mass, std::move(basis), modes.soft());
  result.mass = prepared.mass;
  if (result.structure->status() != Status::converged) {
    result.status = result.structure->status();
    result.message = "the stiffness is not positive definite on the complement of the kept modes";
    return result;
  }
  const Eigen::MatrixXd& phi = result.structure->basis().vectors;
  result.static_force = phi.transpose() * full.static_force;
  result.cosine_force = phi.transpose() * full.cosine_force;
  result.sine_force = phi.transpose() * full.sine_force;
  result.outputs = phi.transpose() * full.outputs;
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

namespace {

/// Lambda + Phi_r^T G^-1 Phi_r [m, m].
Eigen::MatrixXd glued_stiffness(const RitzBasis& basis, const Eigen::LLT<Eigen::MatrixXd>& flexibility,
                                const Eigen::MatrixXd& on_contact) {
  Eigen::MatrixXd glued = on_contact.transpose() * flexibility.solve(on_contact);
  glued = (0.5 * (glued + glued.transpose())).eval();
  glued.diagonal() += basis.eigenvalues;
  return glued;
}

}  // namespace

Eigen::VectorXd glued_frequencies(const TraceModel& trace) {
  const RitzBasis& basis = trace.structure->basis();
  const Eigen::MatrixXd& flexibility = trace.structure->on_contact();
  const Eigen::LLT<Eigen::MatrixXd> g(flexibility);
  const Eigen::MatrixXd on_contact = basis.vectors.bottomRows(flexibility.rows());
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(glued_stiffness(basis, g, on_contact),
                                                             Eigen::EigenvaluesOnly);
  return eigen.eigenvalues().cwiseMax(0.0).cwiseSqrt();
}

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
  result.first_neglected_eigenvalue = trace.first_neglected_eigenvalue;
  result.rigid_modes = trace.rigid_modes;
  result.negative_modes = trace.negative_modes;
  result.seconds_factorisation = trace.seconds_factorisation;
  result.seconds_contact_solves = trace.seconds_contact_solves;
  result.seconds_modes = trace.seconds_modes;
  result.seconds_total = trace.seconds_total;
  if (trace.status != Status::converged) return result;

  const RitzBasis& basis = trace.structure->basis();
  result.free_eigenvalues = basis.eigenvalues;
  result.full_mass = trace.mass;
  const Eigen::SparseMatrix<double> a = for_directions(average, contact.directions());
  const Eigen::Index nodal = a.rows(), m = basis.vectors.cols();
  const Eigen::MatrixXd flexibility = a * trace.structure->on_contact() * a.transpose();
  const Eigen::LLT<Eigen::MatrixXd> g(0.5 * (flexibility + flexibility.transpose()));
  if (g.info() != Eigen::Success || !(g.rcond() > 1e-14)) {
    result.status = Status::singular;
    result.message = "the residual flexibility of the contact is not positive definite: too many modes are kept";
    return result;
  }
  const Eigen::MatrixXd inverse = g.solve(Eigen::MatrixXd::Identity(nodal, nodal));
  const Eigen::MatrixXd free_on_contact = a * basis.vectors.bottomRows(a.cols());
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(glued_stiffness(basis, g, free_on_contact));
  if (m > 0 && !(eigen.eigenvalues()(0) > 0)) {
    result.status = Status::singular;
    result.message = "the glued structure is not positive definite";
    return result;
  }
  // Coordinates [u; q], q rotated to the glued modes.
  const Eigen::MatrixXd& rotation = eigen.eigenvectors();
  result.glued_frequencies = eigen.eigenvalues().cwiseSqrt();
  using Columns = Recovery::Columns;
  result.recovery.linear = [structure = trace.structure, rotation, a](const Columns& q, const Columns& lambda) {
    const Eigen::MatrixXd force = lambda.size() > 0 ? Eigen::MatrixXd(-a.transpose() * lambda) : Eigen::MatrixXd();
    return structure->field(rotation * q.bottomRows(rotation.rows()), force);
  };

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

  result.seconds_total += seconds_since(start);
  return result;
}

Eigen::MatrixXd Reduction::neglected_inertia(const Eigen::Ref<const Eigen::MatrixXd>& coordinates) const {
  // lambda = -K_red[u rows] (u, q): its field comes on top of Phi q, whose inertia the model has.
  const Eigen::Index contact = model.size() - glued_frequencies.size();
  const Eigen::MatrixXd none = Eigen::MatrixXd::Zero(coordinates.rows(), coordinates.cols());
  const Eigen::MatrixXd beyond = recovery.apply(none, -model.stiffness.topRows(contact) * coordinates);
  const Eigen::MatrixXd represented = recovery.apply(coordinates, Eigen::MatrixXd());
  const Eigen::MatrixXd inertia = *full_mass * beyond;
  const Eigen::MatrixXd half = inertia.transpose() * (represented + 0.5 * beyond);
  return half + half.transpose();
}

double Reduction::frequency_error(Eigen::Index mode) const {
  const Eigen::Index contact = model.size() - glued_frequencies.size();
  return 0.5 * neglected_inertia(Eigen::VectorXd::Unit(model.size(), contact + mode))(0, 0);
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
