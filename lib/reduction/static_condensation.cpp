#include "reduction/static_condensation.hpp"

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

}  // namespace dovetail::reduction
