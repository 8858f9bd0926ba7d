#include <algorithm>

#include "numerics/dense_symmetric.hpp"
#include "stability/params.hpp"
#include "stability/perturbation.hpp"

namespace dovetail::stability {
namespace {

struct Split {
  std::vector<Eigen::Index> linear, switching;  // dofs of the model
  std::vector<Eigen::Index> normals;            // of nodes that open and close
};

// Largest entry of the rows `rows`.
double largest(const Eigen::MatrixXd& matrix, const std::vector<Eigen::Index>& rows) {
  return rows.empty() ? 0.0 : Eigen::MatrixXd(matrix(rows, Eigen::all)).cwiseAbs().maxCoeff();
}

Split split(const reduction::ReducedModel& model, const std::vector<ContactTimeline>& timelines,
            PerturbedStructure& structure) {
  Split result;
  const Eigen::Index directions = model.contact.tangential.cols();
  std::vector<char> linear(static_cast<std::size_t>(model.size()), 1);
  const auto take = [&](Eigen::Index dof) {
    linear[static_cast<std::size_t>(dof)] = 0;
    return dof;
  };
  for (Eigen::Index i = 0; i < model.contact.count(); ++i) {
    const ContactTimeline& timeline = timelines[static_cast<std::size_t>(i)];
    const bool opens = timeline.ever(SampleState::separated), friction = timeline.rubs();
    if (timeline.always(SampleState::separated)) continue;
    const Eigen::Index normal = take(model.contact.normal(i));
    SwitchingNode node;
    node.timeline = &timeline;
    if (timeline.always(SampleState::stuck)) {
      for (Eigen::Index r = 0; r < directions; ++r) take(model.contact.tangential(i, r));
      structure.neutral += static_cast<int>(directions);
      continue;
    }
    if (!opens && !friction) continue;
    node.normal = static_cast<Eigen::Index>(result.switching.size());
    result.switching.push_back(normal);
    if (opens) result.normals.push_back(normal);
    for (Eigen::Index r = 0; friction && r < directions; ++r) {
      node.tangential.push_back(static_cast<Eigen::Index>(result.switching.size()));
      result.switching.push_back(take(model.contact.tangential(i, r)));
    }
    // With one direction, slip leaves nothing to remember; with two, the direction of slip is a memory.
    if (friction && (timeline.ever(SampleState::stuck) || directions == 2)) {
      node.memory = structure.memory;
      structure.memory += directions;
    }
    structure.nodes.push_back(node);
  }
  for (Eigen::Index dof = 0; dof < model.size(); ++dof)
    if (linear[static_cast<std::size_t>(dof)] != 0) result.linear.push_back(dof);
  return result;
}

Eigen::MatrixXd symmetric(const Eigen::MatrixXd& matrix) {
  return (matrix + matrix.transpose()) / 2;
}

}  // namespace

PerturbedStructure perturbed_structure(const reduction::ReducedModel& model, double omega,
                                       const std::vector<ContactTimeline>& timelines) {
  PerturbedStructure structure;
  structure.omega = omega;
  const Split dofs = split(model, timelines, structure);
  const double mass_scale = model.mass.size() > 0 ? model.mass.cwiseAbs().maxCoeff() : 0;
  const auto refuse = [&](bool meaningful, const char* reason) {
    structure.meaningful = meaningful;
    structure.reason = reason;
    return structure;
  };
  if (!(mass_scale > 0)) return refuse(false, "the model has no mass: a quasi-static cycle has no motion to perturb");
  if (largest(model.mass, dofs.normals) > StabilityParams{}.nothing * mass_scale)
    return refuse(false,
                  "contact dofs that lift off carry mass: what follows a touch depends on an impact law the model does "
                  "not have");
  if (largest(model.mass, dofs.switching) > StabilityParams{}.nothing * mass_scale)
    return refuse(true, "contact dofs that slip carry mass: their stability is not computed");
  const double force_scale = model.stiffness.cwiseAbs().maxCoeff();
  if (omega * largest(model.damping, dofs.switching) > StabilityParams{}.nothing * force_scale)
    return refuse(true, "contact dofs that change state are damped: their stability is not computed");

  // Linear dofs in coordinates of unit or no mass.
  const Eigen::MatrixXd mass = symmetric(model.mass(dofs.linear, dofs.linear));
  Eigen::MatrixXd basis = Eigen::MatrixXd::Identity(mass.rows(), mass.cols());
  Eigen::VectorXd masses = mass.diagonal();
  if (!mass.isDiagonal(StabilityParams{}.diagonal)) {
    numerics::SymmetricPairs pairs = numerics::all_pairs<double>(mass);
    if (pairs.status != Status::converged) return refuse(false, "the mass matrix could not be decomposed");
    basis = std::move(pairs.vectors);
    masses = std::move(pairs.values);
  }
  std::vector<Eigen::Index> dynamic, still;
  for (Eigen::Index j = 0; j < masses.size(); ++j)
    (masses(j) > StabilityParams{}.nothing * mass_scale ? dynamic : still).push_back(j);
  if (dynamic.empty()) return refuse(false, "all mass is held by nodes that stay stuck: there is no motion to perturb");
  const Eigen::VectorXd scale = masses(dynamic).cwiseSqrt().cwiseInverse();
  const Eigen::MatrixXd heavy = basis(Eigen::all, dynamic) * scale.asDiagonal(), light = basis(Eigen::all, still);

  const Eigen::MatrixXd stiffness = symmetric(model.stiffness), damping = symmetric(model.damping);
  const Eigen::MatrixXd linear_stiffness = stiffness(dofs.linear, dofs.linear);
  const Eigen::MatrixXd linear_damping = damping(dofs.linear, dofs.linear);
  if (light.cols() > 0 &&
      omega * (linear_damping * light).cwiseAbs().maxCoeff() > StabilityParams{}.nothing * force_scale)
    return refuse(true, "dofs without mass are damped: their stability is not computed");
  structure.dynamic = heavy.transpose() * linear_stiffness * heavy / (omega * omega);
  structure.damping = heavy.transpose() * linear_damping * heavy / omega;
  const auto switching = static_cast<Eigen::Index>(dofs.switching.size()), free = light.cols();
  const Eigen::MatrixXd across = stiffness(dofs.switching, dofs.linear);
  structure.coupling.resize(switching + free, heavy.cols());
  structure.coupling << across * heavy, light.transpose() * linear_stiffness * heavy;
  structure.stiffness.resize(switching + free, switching + free);
  structure.stiffness << Eigen::MatrixXd(stiffness(dofs.switching, dofs.switching)), across * light,
      (across * light).transpose(), light.transpose() * linear_stiffness * light;
  for (Eigen::Index j = 0; j < free; ++j) structure.free_static.push_back(switching + j);
  return structure;
}

}  // namespace dovetail::stability
