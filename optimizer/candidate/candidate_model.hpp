#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "fem/contact_cells.hpp"
#include "geometry/mesh/mesh_motion.hpp"
#include "geometry/rules/feasibility.hpp"
#include "optimizer/candidate/contact_nodes.hpp"
#include "optimizer/candidate/matrices_store.hpp"
#include "optimizer/problem/outcome.hpp"
#include "optimizer/scene/scene.hpp"
#include "optimizer/scene/scene_kind.hpp"
#include "reduction/massless_boundary.hpp"
#include "steady/preload.hpp"

namespace dovetail::optimizer {

/// Everything between the dimensions of a candidate and its vibration: profile, mesh, finite elements at
/// speed, reduced model, preload. Members after the stage that failed are empty.
struct CandidateModel {
  std::string status = status_of(Outcome::converged);  ///< converged, infeasible, or the stage that failed and why
  std::vector<std::string> messages;                   ///< broken rules, re-meshing: for people

  geometry::Feasibility feasibility;
  geometry::MeshedSector mesh;  ///< its flanks are the trace of the contact
  DesignMatrices matrices;
  // With contact nodes on the trace, see lay_contact:
  fem::ContactCells cells;
  reduction::Reduction reduction;
  reduction::ReducedModel model;  ///< of it, with the rough interface and the slip that the preload leaves
  std::shared_ptr<const dynamics::CondensedModel> condensed;
  Eigen::VectorXd glued_frequencies;  ///< rad/s, ascending: all contact nodes stuck, asperities between them elastic
  steady::Preload preload;
  SharedBudget budget;             ///< of everything computed with contact; counts also where nothing is limited
  double jacobian_operations = 1;  ///< what it counts for a Jacobian in which all contact nodes take part

  std::map<std::string, double> sizes;      ///< dofs, contact nodes, modes, ...
  std::map<std::string, double> timings_s;  ///< by stage

  [[nodiscard]] bool converged() const { return outcome_of(status) == Outcome::converged; }
  [[nodiscard]] bool infeasible() const { return outcome_of(status) == Outcome::infeasible; }
};

/// The geometric rules of a scene.
[[nodiscard]] geometry::Feasibility feasibility_of(const Scene& scene);

/// Lays contact nodes on the trace of a candidate whose matrices are there, in place of those it has: reduced model and
/// preload. A stage that fails is named in its status. Cost: dense algebra of their number and a preload.
void lay_contact(const Scene& scene, const std::vector<fem::FlankCells>& flanks, CandidateModel& candidate);

/// A budget for what is computed on a candidate with contact nodes, `times` the limits in `solver`.
[[nodiscard]] SharedBudget new_budget(const SolverSettings& solver, const CandidateModel& candidate, double times = 1);

/// Gives the candidate a new one for what is computed on it next.
void renew_budget(const SolverSettings& solver, CandidateModel& candidate);

/// Builds the models of many candidates on one mesh topology, that of the reference scene's geometry and
/// mesh sizes. When the reference is a geometry that cannot be meshed, each candidate is meshed on its own
/// topology and says so. A candidate's model depends on the reference and the candidate only. `build` may be called
/// from several threads.
class ModelBuilder {
 public:
  /// Throws InputError for a reference that violates its ranges.
  explicit ModelBuilder(const Scene& reference);

  /// Stages in order: feasibility, mesh motion, assembly, preload without geometric stiffness (for the stresses it
  /// comes from), stiffness at speed, reduction to the trace, contact nodes by the sizes of the scene. Matrices that
  /// the last candidate had, too, are not computed again. The scene's kind and mesh sizes must be the reference's.
  /// Throws InputError for a scene that violates its ranges.
  [[nodiscard]] CandidateModel build(const Scene& scene) const;

 private:
  [[nodiscard]] geometry::MeshedSector mesh_of(const Scene& scene) const;

  Mesher mesher_;  // empty when the reference cannot be meshed
  std::shared_ptr<MatricesStore> store_;
};

}  // namespace dovetail::optimizer
