#include "reduction/static_condensation.hpp"

#include <Eigen/Dense>
#include <chrono>

#include "reduction/contact_order.hpp"
#include "reduction/contact_solver.hpp"
#include "reduction/validation.hpp"

namespace dovetail::reduction {

StaticCondensation condense_statically(const FullModel& full) {
  const auto start = std::chrono::steady_clock::now();
  if (const std::vector<Violation> found = violations(full); !found.empty()) throw InputError(found);
  StaticCondensation result;
  ContactSolver solver;
  const Eigen::Index contact = full.contact_size();
  result.status = solver.factorise(full.stiffness, contact);
  result.seconds_factorisation = solver.seconds_factorisation();
  if (result.status != Status::converged) return result;

  ReducedModel& model = result.model;
  model.stiffness = solver.schur();
  model.mass = Eigen::MatrixXd::Zero(contact, contact);
  model.damping = model.mass;
  model.contact = contact_first(full.contact);
  model.static_force = solver.condense(full.static_force);
  model.cosine_force = solver.condense(full.cosine_force).transpose();
  model.sine_force = solver.condense(full.sine_force).transpose();
  model.output_vectors = solver.condense(full.outputs).transpose();
  model.output_names = full.output_names;

  const Eigen::Index internal = full.internal_size();
  result.recovery.basis.resize(full.size(), contact);
  result.recovery.basis.topRows(internal) = solver.response();
  result.recovery.basis.bottomRows(contact).setIdentity();
  result.recovery.offset = Eigen::VectorXd::Zero(full.size());
  result.recovery.offset.head(internal) = solver.solve_internal(full.static_force.head(internal));
  result.seconds_total = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return result;
}

StaticCondensation on_contact(const StaticCondensation& trace, const Eigen::SparseMatrix<double>& average,
                              ContactNodes contact) {
  StaticCondensation result = trace;
  if (trace.status != Status::converged) return result;
  // min 1/2 v^T S v - f^T v with A v = u. A body that nothing holds makes S singular, but never S + s A^T A, which
  // changes the energy by 1/2 s u^T u alone: taken off again in the end.
  const Eigen::SparseMatrix<double> a = for_directions(average, contact.directions());
  const double scale = trace.model.stiffness.diagonal().mean();
  const Eigen::MatrixXd held = trace.model.stiffness + scale * Eigen::MatrixXd(a.transpose() * a);
  const Eigen::LLT<Eigen::MatrixXd> factor(held);
  const Eigen::MatrixXd response = factor.solve(Eigen::MatrixXd(a.transpose()));
  const Eigen::LLT<Eigen::MatrixXd> flexibility(a * response);
  if (factor.info() != Eigen::Success || flexibility.info() != Eigen::Success) {
    result.status = Status::singular;
    return result;
  }
  const Eigen::MatrixXd stiffness = flexibility.solve(Eigen::MatrixXd::Identity(a.rows(), a.rows()));
  const Eigen::MatrixXd shape = response * stiffness;  // v of unit u
  ReducedModel& model = result.model;
  model.stiffness = 0.5 * (stiffness + stiffness.transpose());
  model.stiffness.diagonal().array() -= scale;
  model.mass = Eigen::MatrixXd::Zero(a.rows(), a.rows());
  model.damping = model.mass;
  model.contact = contact_first(std::move(contact));
  model.static_force = shape.transpose() * trace.model.static_force;
  model.cosine_force = trace.model.cosine_force * shape;
  model.sine_force = trace.model.sine_force * shape;
  model.output_vectors = trace.model.output_vectors * shape;
  const Eigen::VectorXd free = factor.solve(trace.model.static_force);
  result.recovery.offset += trace.recovery.basis * (free - shape * (a * free));
  result.recovery.basis = trace.recovery.basis * shape;
  return result;
}

}  // namespace dovetail::reduction
