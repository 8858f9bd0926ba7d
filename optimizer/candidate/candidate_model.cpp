#include "optimizer/candidate/candidate_model.hpp"

#include <utility>

#include "fem/flank_trace.hpp"
#include "optimizer/candidate/cell_grid.hpp"
#include "optimizer/candidate/stopwatch.hpp"
#include "steady/work.hpp"

namespace dovetail::optimizer {

namespace {

std::string first_broken(const geometry::Feasibility& feasibility, std::vector<std::string>& messages) {
  for (const geometry::Rule& rule : feasibility.rules)
    if (rule.margin < 0) messages.push_back(rule.sentence);
  return status_of(Outcome::infeasible);
}

double jacobian_operations(const SolverSettings& solver, const CandidateModel& candidate) {
  return steady::jacobian_operations(candidate.cells.count(), candidate.matrices.shared->system.full.dimensions,
                                     solver.harmonics, solver.samples);
}

/// At rest the bodies hold themselves where the contact is held; in rotation the pull grows with what it moves.
void note_lost_equilibrium(const Scene& scene, CandidateModel& candidate) {
  if (scene.loading.speed == 0 || candidate.status.find(to_string(Status::singular)) == std::string::npos) return;
  candidate.messages.push_back("At scene.speed_rpm = " + shortest(parameter(scene, "scene.speed_rpm")) +
                               " no equilibrium exists: the centrifugal load grows faster with the displacements than "
                               "the forces that hold them. Give a lower speed.");
}

std::map<std::string, double> sizes_of(const Scene& scene, const CandidateModel& candidate) {
  const fem::Mesh& mesh = candidate.mesh.sector.mesh;
  return {{"nodes", mesh.node_count()},
          {"elements", mesh.element_count()},
          {"dofs", static_cast<double>(candidate.matrices.shared->system.size())},
          {"contact_nodes", static_cast<double>(candidate.cells.count())},
          {"modes", scene.solver.modes},
          {"reduced_size", static_cast<double>(candidate.model.size())},
          {"harmonics", scene.solver.harmonics},
          {"samples", scene.solver.samples},
          {"remeshed", candidate.mesh.remeshed ? 1.0 : 0.0},
          {"minimum_scaled_jacobian", candidate.mesh.quality.minimum_scaled_jacobian}};
}

}  // namespace

geometry::Feasibility feasibility_of(const Scene& scene) {
  geometry::FeasibilityLimits limits = scene.limits;
  limits.friction = scene.contact.friction;
  return scene.kind->feasibility(scene, limits);
}

SharedBudget new_budget(const SolverSettings& solver, const CandidateModel& candidate, double times) {
  return std::make_shared<Budget>(
      solver.max_jacobians > 0 ? times * solver.max_jacobians * jacobian_operations(solver, candidate) : kInfinity,
      solver.time_limit > 0 ? times * solver.time_limit : kInfinity);
}

void renew_budget(const SolverSettings& solver, CandidateModel& candidate) {
  candidate.jacobian_operations = jacobian_operations(solver, candidate);
  candidate.budget = new_budget(solver, candidate);
}

void lay_contact(const Scene& scene, const std::vector<fem::FlankCells>& flanks, CandidateModel& candidate) {
  candidate.cells = fem::contact_cells(candidate.mesh.sector, flanks);
  candidate.reduction =
      reduction::reduce(candidate.matrices.trace, candidate.cells.average,
                        contact_nodes(candidate.cells, 0, scene.contact), scene.loading.damping_ratio);
  if (candidate.reduction.status != Status::converged) {
    candidate.status = failed_at("reduction", candidate.reduction.status) + ": " + candidate.reduction.message;
    return;
  }
  candidate.model = candidate.reduction.model;
  reduction::add_interface(interface_of(scene.contact), candidate.model, &candidate.reduction.recovery);
  candidate.preload = steady::quasi_static(std::make_shared<const dynamics::CondensedModel>(candidate.model),
                                           {.budget = candidate.budget});
  if (candidate.preload.status != Status::converged) {
    candidate.status = failed_at("preload", candidate.preload.status);
    return;
  }
  candidate.model.contact.slip_origin = candidate.preload.slip_origin;
  candidate.condensed = std::make_shared<const dynamics::CondensedModel>(candidate.model);
  candidate.glued_frequencies = interface_of(scene.contact).rigid() ? candidate.reduction.glued_frequencies
                                                                    : candidate.condensed->glued_frequencies();
}

ModelBuilder::ModelBuilder(const Scene& reference)
    : store_(std::make_shared<MatricesStore>(reference.contact.friction)) {
  if (std::vector<Violation> found = violations(reference); !found.empty()) throw InputError(std::move(found));
  try {
    mesher_ = reference.kind->mesher(reference);
  } catch (const InputError&) {
    // All ranges hold, so the boundary crosses itself: no reason to refuse candidates whose own does not.
  }
}

geometry::MeshedSector ModelBuilder::mesh_of(const Scene& scene) const {
  if (mesher_) return mesher_(scene);
  geometry::MeshedSector own = scene.kind->mesher(scene)(scene);
  own.remeshed = true;
  own.note = "The reference design cannot be meshed, so this design is its own reference. " + own.note;
  return own;
}

CandidateModel ModelBuilder::build(const Scene& scene) const {
  if (std::vector<Violation> found = violations(scene); !found.empty()) throw InputError(std::move(found));
  CandidateModel candidate;
  Stopwatch watch;

  candidate.feasibility = feasibility_of(scene);
  candidate.timings_s["feasibility"] = watch.lap();
  if (!candidate.feasibility.feasible) {
    candidate.status = first_broken(candidate.feasibility, candidate.messages);
    return candidate;
  }

  try {
    candidate.mesh = mesh_of(scene);
  } catch (const InputError& error) {
    candidate.status = failed_at("mesh", error.what());
    return candidate;
  }
  if (candidate.mesh.remeshed) candidate.messages.push_back(candidate.mesh.note);
  candidate.timings_s["mesh"] = watch.lap();
  if (candidate.mesh.quality.inverted_elements > 0) {
    candidate.status = failed_at("mesh", candidate.mesh.note);
    return candidate;
  }

  candidate.mesh.sector = fem::with_trace(candidate.mesh.sector);
  const std::vector<fem::FlankCells> cells = cell_grid(scene, candidate.mesh.sector, cell_lengths(scene));
  candidate.cells = fem::contact_cells(candidate.mesh.sector, cells);
  candidate.timings_s["mesh"] += watch.lap();
  candidate.matrices = store_->matrices(scene, candidate.mesh.sector, candidate.cells, candidate.timings_s);
  candidate.status = candidate.matrices.status;
  if (!candidate.converged()) {
    note_lost_equilibrium(scene, candidate);
    return candidate;
  }
  watch = {};
  renew_budget(scene.solver, candidate);
  lay_contact(scene, cells, candidate);
  candidate.timings_s["preload"] = watch.lap();
  if (!candidate.converged()) return candidate;

  candidate.sizes = sizes_of(scene, candidate);
  return candidate;
}

}  // namespace dovetail::optimizer
