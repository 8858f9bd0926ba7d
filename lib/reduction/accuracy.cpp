#include "reduction/accuracy.hpp"

#include <Eigen/Dense>
#include <Eigen/SparseCholesky>
#include <cmath>
#include <limits>
#include <vector>

namespace dovetail::reduction {

namespace {

// Coordinates that are not contact dofs, and the contact dofs node by node.
struct Split {
  std::vector<Eigen::Index> contact, internal;

  explicit Split(const ReducedModel& model) {
    std::vector<bool> is_contact(static_cast<std::size_t>(model.size()), false);
    for (Eigen::Index node = 0; node < model.contact.count(); ++node) {
      contact.push_back(model.contact.normal(node));
      for (Eigen::Index t = 0; t < model.contact.tangential.cols(); ++t)
        contact.push_back(model.contact.tangential(node, t));
    }
    for (Eigen::Index dof : contact) is_contact[static_cast<std::size_t>(dof)] = true;
    for (Eigen::Index dof = 0; dof < model.size(); ++dof)
      if (!is_contact[static_cast<std::size_t>(dof)]) internal.push_back(dof);
  }
};

// Q = -D_ii^-1 D_ir and Z = D_rr + D_ri Q.
struct Condensed {
  Eigen::MatrixXd response, stiffness;
};

Condensed condense(const ReducedModel& model, const Split& split, double angular_frequency) {
  const Eigen::MatrixXd dynamic = model.stiffness - angular_frequency * angular_frequency * model.mass;
  Condensed result;
  result.stiffness = dynamic(split.contact, split.contact);
  if (split.internal.empty()) return result;
  const Eigen::MatrixXd coupling = dynamic(split.internal, split.contact);
  const Eigen::MatrixXd interior = dynamic(split.internal, split.internal);
  result.response = -interior.partialPivLu().solve(coupling);
  result.stiffness += coupling.transpose() * result.response;
  return result;
}

double relative(const Eigen::MatrixXd& difference, const Eigen::MatrixXd& reference) {
  return difference.norm() / reference.norm();
}

}  // namespace

Eigen::MatrixXd condensed_stiffness(const ReducedModel& model, double angular_frequency) {
  return condense(model, Split(model), angular_frequency).stiffness;
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
      error.stiffness = relative(reduced - exact, exact);
      const Eigen::MatrixXd inverse = exact.partialPivLu().inverse();
      error.flexibility = relative(reduced.partialPivLu().inverse() - inverse, inverse);
    }
    errors.push_back(error);
  }
  return errors;
}

StiffnessError estimate(const Reduction& reduction, double angular_frequency) {
  StiffnessError error{.angular_frequency = angular_frequency,
                       .stiffness = std::numeric_limits<double>::infinity(),
                       .flexibility = std::numeric_limits<double>::infinity()};
  const double square = angular_frequency * angular_frequency;
  const double remaining = 1 - square / reduction.first_neglected_eigenvalue;
  if (reduction.model.size() == 0 || !(remaining > 0)) return error;
  const Condensed condensed = condense(reduction.model, Split(reduction.model), angular_frequency);
  const Eigen::Index contact = condensed.stiffness.rows();
  Eigen::MatrixXd field(reduction.model.size(), contact);
  field.topRows(contact).setIdentity();
  field.bottomRows(field.rows() - contact) = condensed.response;
  const Eigen::MatrixXd change = square / remaining * reduction.neglected_inertia(field);
  const Eigen::MatrixXd inverse = condensed.stiffness.partialPivLu().inverse();
  error.stiffness = relative(change, condensed.stiffness);
  error.flexibility = relative(inverse * change * inverse, inverse);
  return error;
}

}  // namespace dovetail::reduction
