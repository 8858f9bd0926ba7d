#include "reduction/static_condensation.hpp"

#include <memory>
#include <utility>

#include "numerics/dense_product.hpp"
#include "numerics/dense_symmetric.hpp"
#include "numerics/partial_cholesky.hpp"
#include "reduction/contact_order.hpp"
#include "reduction/validation.hpp"

namespace dovetail::reduction {

StaticCondensation condense_statically(const FullModel& full) {
  if (const std::vector<Violation> found = violations(full); !found.empty()) throw InputError(found);
  StaticCondensation result;
  const auto factor = std::make_shared<numerics::PartialCholesky>();
  const Eigen::Index contact = full.contact_size();
  result.status = factor->factorise(full.stiffness, contact, full.order.get());
  if (result.status != Status::converged) return result;

  Eigen::MatrixXd loads(full.size(), 1 + full.cosine_force.cols() + full.sine_force.cols() + full.outputs.cols());
  loads << full.static_force, full.cosine_force, full.sine_force, full.outputs;
  loads = factor->eliminate(loads);
  const Eigen::MatrixXd condensed = loads.bottomRows(contact).transpose();
  ReducedModel& model = result.model;
  model.stiffness = factor->schur();
  model.mass = Eigen::MatrixXd::Zero(contact, contact);
  model.damping = model.mass;
  model.contact = contact_first(full.contact);
  model.static_force = condensed.row(0);
  model.cosine_force = condensed.middleRows(1, full.cosine_force.cols());
  model.sine_force = condensed.middleRows(1 + full.cosine_force.cols(), full.sine_force.cols());
  model.output_vectors = condensed.bottomRows(full.outputs.cols());
  model.output_names = full.output_names;

  loads.col(0).tail(contact).setZero();
  result.recovery.offset = factor->substitute(loads.col(0));
  using Columns = Recovery::Columns;
  result.recovery.linear = [factor](const Columns& r, const Columns&) {
    Eigen::MatrixXd field = Eigen::MatrixXd::Zero(factor->size(), r.cols());
    field.bottomRows(r.rows()) = r;
    return factor->substitute(field);
  };
  return result;
}

StaticCondensation on_contact(const StaticCondensation& trace, const Eigen::SparseMatrix<double>& average,
                              ContactNodes contact) {
  StaticCondensation result;
  result.status = trace.status;
  if (trace.status != Status::converged) return result;
  // min 1/2 v^T S v - f^T v with A v = u. A body that nothing holds makes S singular, but never S + s A^T A, which
  // changes the energy by 1/2 s u^T u alone: taken off again in the end.
  const Eigen::SparseMatrix<double> a = for_directions(average, contact.directions());
  const double scale = trace.model.stiffness.diagonal().mean();
  Eigen::MatrixXd held = trace.model.stiffness;
  held += scale * Eigen::SparseMatrix<double>(a.transpose() * a);
  const numerics::DenseCholesky factor(std::move(held));
  result.status = factor.status();
  if (result.status != Status::converged) return result;
  const Eigen::MatrixXd response = factor.solve(Eigen::MatrixXd(a.transpose()));
  const numerics::DenseCholesky flexibility(a * response);
  result.status = flexibility.status();
  if (result.status != Status::converged) return result;
  const Eigen::MatrixXd stiffness = flexibility.solve(Eigen::MatrixXd::Identity(a.rows(), a.rows()));
  const Eigen::MatrixXd shape = numerics::product(response, stiffness);  // v of unit u
  ReducedModel& model = result.model;
  model.stiffness = 0.5 * (stiffness + stiffness.transpose());
  model.stiffness.diagonal().array() -= scale;
  model.mass = Eigen::MatrixXd::Zero(a.rows(), a.rows());
  model.damping = model.mass;
  model.contact = contact_first(std::move(contact));
  model.static_force = shape.transpose() * trace.model.static_force;
  model.cosine_force = numerics::product(trace.model.cosine_force, shape);
  model.sine_force = numerics::product(trace.model.sine_force, shape);
  model.output_vectors = numerics::product(trace.model.output_vectors, shape);
  model.output_names = trace.model.output_names;
  const Eigen::VectorXd free = factor.solve(trace.model.static_force);
  result.recovery.offset = trace.recovery.offset + trace.recovery.linear(free - shape * (a * free), Eigen::MatrixXd());
  using Columns = Recovery::Columns;
  result.recovery.linear = [of_trace = trace.recovery.linear, shape](const Columns& u, const Columns& lambda) {
    return of_trace(numerics::product(shape, u), lambda);
  };
  return result;
}

}  // namespace dovetail::reduction
