#include "tests/unit/reduction/stiffness_error.hpp"

#include <Eigen/SparseCholesky>
#include <limits>

#include "numerics/dense_lu.hpp"

namespace dovetail::reduction {

Eigen::MatrixXd condensed_stiffness(const ReducedModel& model, double angular_frequency) {
  const Eigen::Index contact = model.contact.count() * model.contact.directions(), internal = model.size() - contact;
  const Eigen::MatrixXd dynamic = model.stiffness - angular_frequency * angular_frequency * model.mass;
  const Eigen::MatrixXd corner = dynamic.topLeftCorner(contact, contact);
  if (internal == 0) return corner;
  const Eigen::MatrixXd coupling = dynamic.bottomLeftCorner(internal, contact);
  const numerics::DenseLu factor(dynamic.bottomRightCorner(internal, internal));
  return corner - coupling.transpose() * factor.solve(coupling);
}

Eigen::MatrixXd condensed_stiffness(const FullModel& model, double angular_frequency) {
  const Eigen::Index contact = model.contact_size();
  const Eigen::Index internal = model.internal_size();
  const Eigen::SparseMatrix<double> dynamic = model.stiffness - angular_frequency * angular_frequency * model.mass;
  const Eigen::SparseMatrix<double> interior = dynamic.topLeftCorner(internal, internal);
  const Eigen::SparseMatrix<double> coupling = dynamic.topRightCorner(internal, contact);
  const Eigen::SparseMatrix<double> corner = dynamic.bottomRightCorner(contact, contact);
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor(interior);
  if (factor.info() != Eigen::Success) return {};
  const Eigen::MatrixXd dense_coupling(coupling);
  Eigen::MatrixXd response = factor.solve(dense_coupling);
  // LDL^T without pivoting loses digits on an indefinite matrix; one refinement gives them back.
  response += factor.solve(dense_coupling - interior * response);
  return Eigen::MatrixXd(corner) - coupling.transpose() * response;
}

std::vector<StiffnessError> compare(const FullModel& full, const Reduction& reduction,
                                    std::span<const double> angular_frequencies) {
  std::vector<StiffnessError> errors;
  for (double angular_frequency : angular_frequencies) {
    const Eigen::MatrixXd exact = condensed_stiffness(full, angular_frequency);
    const Eigen::MatrixXd reduced = condensed_stiffness(reduction.model, angular_frequency);
    StiffnessError error{.angular_frequency = angular_frequency,
                         .stiffness = std::numeric_limits<double>::infinity(),
                         .flexibility = std::numeric_limits<double>::infinity()};
    if (exact.size() > 0 && exact.rows() == reduced.rows()) {
      error.stiffness = (reduced - exact).norm() / exact.norm();
      const auto unit = Eigen::MatrixXd::Identity(exact.rows(), exact.cols());
      const Eigen::MatrixXd inverse = numerics::DenseLu(exact).solve(unit);
      error.flexibility = (numerics::DenseLu(reduced).solve(unit) - inverse).norm() / inverse.norm();
    }
    errors.push_back(error);
  }
  return errors;
}

}  // namespace dovetail::reduction
