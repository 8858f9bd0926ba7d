#include "optimizer/candidate/candidate_model.hpp"

#include <span>
#include <utility>

#include "fem/flank_trace.hpp"
#include "fem/stress.hpp"
#include "optimizer/candidate/cell_grid.hpp"
#include "optimizer/candidate/stopwatch.hpp"
#include "reduction/rough_interface.hpp"
#include "reduction/static_condensation.hpp"
#include "steady/work.hpp"

namespace dovetail::optimizer {

namespace {

/// `surface`: fem::ContactSurface of the trace or fem::ContactCells. Contact dofs begin at `first`.
template <class Surface>
reduction::ContactNodes contact_nodes(const Surface& surface, Eigen::Index first, const ContactProperties& properties) {
  const Eigen::Index count = surface.count(), directions = surface.position.rows();
  reduction::ContactNodes nodes;
  nodes.normal.resize(count);
  nodes.tangential.resize(count, directions - 1);
  for (Eigen::Index i = 0; i < count; ++i) {
    nodes.normal(i) = static_cast<int>(first + directions * i);
    for (Eigen::Index t = 0; t + 1 < directions; ++t)
      nodes.tangential(i, t) = nodes.normal(i) + static_cast<int>(t) + 1;
  }
  nodes.area = surface.area;
  nodes.gap = surface.gap;
  nodes.friction = Eigen::VectorXd::Constant(count, properties.friction);
  nodes.wear_law = properties.wear_law;
  const contact::WearNumbers& wear = properties.wear.at(properties.wear_law);
  nodes.wear_coefficient = Eigen::VectorXd::Constant(count, wear.coefficient);
  if (contact::find_wear_law(properties.wear_law)->parameter(&contact::WearNumbers::threshold))
    nodes.wear_threshold = Eigen::VectorXd::Constant(count, wear.threshold);
  nodes.position = Eigen::MatrixX3d::Zero(count, 3);
  nodes.position.leftCols(directions) = surface.position.transpose();
  nodes.group = surface.flank;
  nodes.slip_origin = Eigen::MatrixXd::Zero(count, directions - 1);
  return nodes;
}

reduction::FullModel full_model(const Scene& scene, const fem::SectorSystem& system,
                                const Eigen::SparseMatrix<double>& stiffness) {
  const double speed = scene.loading.speed;
  reduction::FullModel full;
  full.stiffness = fem::constrain(stiffness, system.constraints);
  full.mass = system.mass;
  full.static_force = speed * speed * system.centrifugal;
  full.cosine_force = scene.loading.tip_force * system.tip;
  full.sine_force = Eigen::MatrixXd::Zero(system.size(), 1);
  full.outputs = system.tip;
  full.output_names = {"tip_x"};
  full.contact = contact_nodes(system.contact, system.internal_size(), scene.contact);
  return full;
}

/// Geometric stiffness from the stresses of the frictional preload: glued flanks would carry tension.
Status geometric_stiffness(const Scene& scene, const CandidateModel& candidate, const fem::Assembler& assembler,
                           std::span<const fem::Material> materials, Eigen::SparseMatrix<double>& result) {
  const fem::SectorSystem& system = candidate.system;
  const Eigen::SparseMatrix<double> bare = system.full.stiffness;
  reduction::StaticCondensation condensed =
      reduction::on_contact(reduction::condense_statically(full_model(scene, system, bare)), candidate.cells.average,
                            contact_nodes(candidate.cells, 0, scene.contact));
  if (condensed.status != Status::converged) return condensed.status;
  reduction::add_interface(interface_of(scene.contact), condensed.model, &condensed.recovery);
  const auto model = std::make_shared<const dynamics::CondensedModel>(condensed.model);
  const steady::Preload preload = steady::quasi_static(model, {.budget = candidate.budget});
  if (preload.status != Status::converged) return preload.status;
  const Eigen::VectorXd independent = condensed.recovery.apply(preload.full_displacement, preload.force);
  const Eigen::VectorXd displacement = system.constraints.transformation * independent;
  const fem::Mesh& mesh = candidate.mesh.sector.mesh;
  result = assembler.geometric_stiffness(mesh, fem::quadrature_stress(mesh, materials, displacement));
  return Status::converged;
}

geometry::Feasibility feasibility_of(const Scene& scene) {
  geometry::FeasibilityLimits limits = scene.limits;
  limits.friction = scene.contact.friction;
  return scene.kind->feasibility(scene, limits);
}

std::string first_broken(const geometry::Feasibility& feasibility, std::vector<std::string>& messages) {
  for (const geometry::Rule& rule : feasibility.rules)
    if (rule.margin < 0) messages.push_back(rule.sentence);
  return status_of(Outcome::infeasible);
}

double jacobian_operations(const SolverSettings& solver, const CandidateModel& candidate) {
  return steady::jacobian_operations(candidate.cells.count(), candidate.system.full.dimensions, solver.harmonics,
                                     solver.samples);
}

std::map<std::string, double> sizes_of(const Scene& scene, const CandidateModel& candidate) {
  const fem::Mesh& mesh = candidate.mesh.sector.mesh;
  return {{"nodes", mesh.node_count()},
          {"elements", mesh.element_count()},
          {"dofs", static_cast<double>(candidate.system.size())},
          {"contact_nodes", static_cast<double>(candidate.cells.count())},
          {"modes", scene.solver.modes},
          {"reduced_size", static_cast<double>(candidate.model.size())},
          {"harmonics", scene.solver.harmonics},
          {"samples", scene.solver.samples},
          {"remeshed", candidate.mesh.remeshed ? 1.0 : 0.0},
          {"minimum_scaled_jacobian", candidate.mesh.quality.minimum_scaled_jacobian}};
}

}  // namespace

reduction::InterfaceStiffness interface_of(const ContactProperties& contact) {
  return {.normal = contact.normal_stiffness, .tangential = contact.tangential_stiffness};
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
      reduction::reduce(candidate.trace, candidate.cells.average, contact_nodes(candidate.cells, 0, scene.contact),
                        scene.loading.damping_ratio);
  if (candidate.reduction.status != Status::converged) {
    candidate.status = failed_at("reduction", candidate.reduction.status) + " " + candidate.reduction.message;
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

ModelBuilder::ModelBuilder(const Scene& reference) {
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
  const std::vector<fem::Material> bodies = materials(scene);
  const fem::Assembler assembler(candidate.mesh.sector.mesh);
  candidate.system = fem::build_sector_system(candidate.mesh.sector, bodies, assembler);
  candidate.timings_s["assembly"] = watch.lap();
  renew_budget(scene.solver, candidate);

  Eigen::SparseMatrix<double> geometric;
  const Status prestress = geometric_stiffness(scene, candidate, assembler, bodies, geometric);
  candidate.timings_s["prestress"] = watch.lap();
  if (prestress != Status::converged) {
    candidate.status = failed_at("prestress", prestress);
    return candidate;
  }

  candidate.stiffness = fem::stiffness_at_speed(candidate.system.full, geometric, scene.loading.speed);
  candidate.trace = reduction::trace_model(full_model(scene, candidate.system, candidate.stiffness),
                                           {.modes = scene.solver.modes, .damping_ratio = scene.loading.damping_ratio});
  candidate.timings_s["reduction"] = watch.lap();
  if (candidate.trace.status != Status::converged) {
    candidate.status = failed_at("reduction", candidate.trace.status) + " " + candidate.trace.message;
    return candidate;
  }
  lay_contact(scene, cells, candidate);
  candidate.timings_s["preload"] = watch.lap();
  if (!candidate.converged()) return candidate;

  candidate.sizes = sizes_of(scene, candidate);
  return candidate;
}

}  // namespace dovetail::optimizer
