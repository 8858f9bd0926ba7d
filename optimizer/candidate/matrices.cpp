#include "optimizer/candidate/matrices.hpp"

#include <map>
#include <set>
#include <span>
#include <utility>

#include "fem/stress.hpp"
#include "optimizer/candidate/contact_nodes.hpp"
#include "optimizer/candidate/params.hpp"
#include "optimizer/scene/scene_kind.hpp"
#include "reduction/static_condensation.hpp"
#include "steady/preload.hpp"
#include "steady/work.hpp"

namespace dovetail::optimizer {

namespace {

PreloadedContact own(const Scene& scene, const fem::ContactCells& cells) {
  return {.contact = scene.contact, .gap = cells.gap};
}

/// As much work as an evaluation may take besides.
SharedBudget budget(const SolverSettings& solver, Eigen::Index nodes, Eigen::Index directions) {
  const double jacobian = steady::jacobian_operations(nodes, directions, solver.harmonics, solver.samples);
  return std::make_shared<Budget>(solver.max_jacobians > 0 ? solver.max_jacobians * jacobian : kInfinity,
                                  solver.time_limit > 0 ? solver.time_limit : kInfinity);
}

/// Displacement of all nodes under the pull of the blade, with friction: glued flanks would carry tension.
Status preloaded(const Scene& scene, const fem::ContactCells& cells, const PreloadedContact& by,
                 const Matrices& matrices, Eigen::VectorXd& displacement) {
  if (matrices.at_rest.status != Status::converged) return matrices.at_rest.status;
  reduction::ContactNodes nodes = contact_nodes(cells, 0, by.contact);
  nodes.gap = by.gap;
  reduction::StaticCondensation condensed = reduction::on_contact(matrices.at_rest, cells.average, nodes);
  if (condensed.status != Status::converged) return condensed.status;
  reduction::add_interface(interface_of(by.contact), condensed.model, &condensed.recovery);
  const auto model = std::make_shared<const dynamics::CondensedModel>(condensed.model);
  const steady::Preload preload =
      steady::quasi_static(model, {.budget = budget(scene.solver, cells.count(), matrices.system.full.dimensions)});
  if (preload.status != Status::converged) return preload.status;
  displacement = matrices.system.constraints.transformation *
                 condensed.recovery.apply(preload.full_displacement, preload.force).col(0);
  return Status::converged;
}

Eigen::SparseMatrix<double> geometric_stiffness(const Scene& scene, const fem::SectorMesh& sector,
                                                const fem::Assembler& assembler, const Eigen::VectorXd& displacement) {
  return assembler.geometric_stiffness(sector.mesh,
                                       fem::quadrature_stress(sector.mesh, materials(scene), displacement));
}

/// Displacements to unit forces on the trace, transposed.
Eigen::MatrixXd forced(const reduction::ResidualFlexibility& structure) {
  const Eigen::Index m = structure.basis().vectors.cols(), trace = structure.on_contact().rows();
  return structure.field(Eigen::MatrixXd::Zero(m, trace), Eigen::MatrixXd::Identity(trace, trace)).transpose();
}

}  // namespace

PreloadedContact stressed(const Scene& scene, const fem::ContactCells& cells, double friction) {
  PreloadedContact result = own(scene, cells);
  if (scene.solver.prestress == Prestress::own) return result;
  result.contact.friction = friction;
  if (scene.solver.prestress == Prestress::shared) result.gap.setZero();
  return result;
}

MatricesStages::MatricesStages(const Scene& scene, const fem::SectorMesh& sector, const fem::ContactCells& cells,
                               const PreloadedContact& by, const KeptPatterns& patterns)
    : scene_(scene), sector_(sector), cells_(cells), by_(by), order_(patterns.order) {
  matrices_->assembler = patterns.assembler;
  matrices_->friction = by.contact.friction;
}

reduction::FullModel MatricesStages::full_model(Eigen::SparseMatrix<double>&& stiffness,
                                                Eigen::SparseMatrix<double>&& mass) const {
  const fem::SectorSystem& system = matrices_->system;
  const double speed = scene_.loading.speed;
  reduction::FullModel full;
  full.stiffness.swap(stiffness);
  full.mass.swap(mass);
  full.static_force = speed * speed * system.centrifugal;
  full.cosine_force = system.tip;
  full.sine_force = Eigen::MatrixXd::Zero(system.size(), 1);
  full.outputs = system.tip;
  full.output_names = {"tip_x"};
  full.order = order_;
  full.contact = contact_nodes(system.contact, system.internal_size(), scene_.contact);
  return full;
}

void MatricesStages::go_on_from(const Matrices& same) {
  matrices_->assembler = same.assembler;
  matrices_->system = same.system;
  matrices_->stiffness = same.stiffness;
  matrices_->trace.structure = same.trace.structure;  // for its factor
  matrices_->at_rest = same.at_rest;
  matrices_->preloaded = same.preloaded;
}

void MatricesStages::assemble() {
  fem::SectorSystem system = fem::build_sector_system(sector_, materials(scene_), *matrices_->assembler);
  swap(matrices_->system, system);
}

// The mass is lent to what is condensed and reduced: beside the factor of a large sector every copy counts.
void MatricesStages::condense() {
  fem::SectorSystem& system = matrices_->system;
  reduction::FullModel full = full_model(std::move(system.stiffness), std::move(system.mass));
  matrices_->at_rest = reduction::condense_statically(full);
  system.mass.swap(full.mass);
}

void MatricesStages::add_prestress() {
  condense();
  const Status prestress = preloaded(scene_, cells_, by_, *matrices_, matrices_->preloaded);
  if (prestress != Status::converged) {
    matrices_->status = failed_at("prestress", prestress);
    return;
  }
  if (scene_.solver.prestress != Prestress::shared) matrices_->at_rest = {};
  fem::stiffness_at_speed(matrices_->system.full,
                          geometric_stiffness(scene_, sector_, *matrices_->assembler, matrices_->preloaded),
                          scene_.loading.speed)
      .swap(matrices_->stiffness);
  Eigen::SparseMatrix<double>().swap(matrices_->system.full.stiffness);  // nothing else needs it
}

void MatricesStages::reduce() {
  // Of the same stiffness, where other modes of it were asked for before.
  const reduction::Factor factor = matrices_->trace.structure ? matrices_->trace.structure->factor() : nullptr;
  fem::SectorSystem& system = matrices_->system;
  reduction::FullModel full =
      full_model(fem::constrain(matrices_->stiffness, system.constraints), std::move(system.mass));
  matrices_->trace = reduction::trace_model(full, {.modes = scene_.solver.modes}, factor);
  system.mass.swap(full.mass);
  if (matrices_->trace.status != Status::converged)
    matrices_->status = failed_at("reduction", matrices_->trace.status) + ": " + matrices_->trace.message;
  else if (scene_.solver.prestress == Prestress::shared)
    matrices_->forced = forced(*matrices_->trace.structure);
}

namespace {

/// Takes the difference to the design's own preload into its matrices. Stress is linear in displacements, and the
/// geometric stiffness in stress.
Status add_own_preload(const Scene& scene, const fem::SectorMesh& sector, const fem::ContactCells& cells,
                       DesignMatrices& result) {
  Eigen::VectorXd displacement;
  const Status status = preloaded(scene, cells, own(scene, cells), *result.shared, displacement);
  if (status != Status::converged) return status;
  result.change =
      geometric_stiffness(scene, sector, *result.shared->assembler, displacement - result.shared->preloaded);
  result.trace.change = std::make_shared<const reduction::StiffnessChange>(reduction::stiffness_change(
      *result.shared->trace.structure, fem::constrain(result.change, result.shared->system.constraints),
      result.shared->forced));
  return Status::converged;
}

}  // namespace

bool shares_matrices(std::string_view key) {
  if (key == "loading.tip_force_n" || key == "loading.damping_ratio") return true;
  if (key.ends_with(".flank_mismatch_um") || key.ends_with(".flank_crown_um")) return true;
  return key.starts_with("contact.") && !key.ends_with("_n_per_m3");  // but the springs of rough flanks
}

namespace {

/// Whether the preload of designs that differ by this key alone is the same under one friction.
bool shares_but_for_friction(std::string_view key) {
  return shares_matrices(key) && !key.starts_with("geometry.");
}

bool shares_preload(std::string_view key) {
  return shares_but_for_friction(key) && !key.starts_with("contact.friction");
}

/// What a case changes but for keys that are `shared`.
std::map<std::string, std::pair<double, double>> unshared(const LoadCase& load, bool (*shared)(std::string_view)) {
  std::map<std::string, std::pair<double, double>> changes;
  for (const auto& [key, value, times] : load.changes)
    if (!shared(key)) changes[key] = {value, times};
  return changes;
}

bool share(const LoadCase& one, const LoadCase& other, bool (*shared)(std::string_view)) {
  return unshared(one, shared) == unshared(other, shared);
}

std::size_t kinds(std::span<const LoadCase> cases, bool (*shared)(std::string_view)) {
  std::set<std::map<std::string, std::pair<double, double>>> found;
  for (const LoadCase& load : cases) found.insert(unshared(load, shared));
  return found.size();
}

}  // namespace

bool share_matrices(const LoadCase& one, const LoadCase& other) {
  return share(one, other, shares_matrices);
}

std::size_t kinds_of_matrices(std::span<const LoadCase> cases, Prestress prestress) {
  switch (prestress) {
    case Prestress::own:
      return kinds(cases, shares_preload);
    case Prestress::cases:
      return kinds(cases, shares_but_for_friction);
    case Prestress::shared:
      break;
  }
  return kinds(cases, shares_matrices);
}

std::vector<std::size_t> by_what_they_share(std::span<const LoadCase> cases) {
  std::vector<std::size_t> order;
  std::vector<bool> placed(cases.size());
  const auto place_like = [&](std::size_t like) {
    for (std::size_t i = like; i < cases.size(); ++i) {
      if (placed[i] || !share(cases[i], cases[like], shares_preload)) continue;
      placed[i] = true;
      order.push_back(i);
    }
  };
  for (std::size_t first = 0; first < cases.size(); ++first)
    for (std::size_t like = first; like < cases.size(); ++like)
      if (!placed[like] && share_matrices(cases[like], cases[first])) place_like(like);
  return order;
}

Eigen::SparseMatrix<double> DesignMatrices::stiffness() const {
  if (change.size() == 0) return shared->stiffness;
  return shared->stiffness + change;
}

Prestress prestress_of(const Scene& scene, const fem::SectorMesh& sector) {
  if (scene.solver.prestress != Prestress::shared) return scene.solver.prestress;
  const double unknowns = static_cast<double>(sector.mesh.nodes.size());
  const double forces = static_cast<double>(fem::contact_surface(sector).position.size());
  return unknowns * forces > MatricesParams{}.largest_fields ? Prestress::own : Prestress::shared;
}

DesignMatrices of_design(const Scene& scene, const fem::SectorMesh& sector, const fem::ContactCells& cells,
                         std::shared_ptr<const Matrices> shared, const PreloadChange& known) {
  DesignMatrices result;
  result.shared = std::move(shared);
  result.status = result.shared->status;
  if (outcome_of(result.status) != Outcome::converged) return result;
  result.trace = result.shared->trace;
  result.trace.cosine_force *= scene.loading.tip_force;
  result.trace.contact =
      contact_nodes(fem::contact_surface(sector), result.shared->system.internal_size(), scene.contact);
  result.by_other = scene.solver.prestress == Prestress::shared || scene.contact.friction != result.shared->friction;
  if (scene.solver.prestress != Prestress::shared) return result;
  if (known.on_trace) {
    result.change = known.stiffness;
    result.trace.change = known.on_trace;
  } else if (const Status status = add_own_preload(scene, sector, cells, result); status != Status::converged) {
    result.status = failed_at("prestress", status);
  }
  return result;
}

}  // namespace dovetail::optimizer
