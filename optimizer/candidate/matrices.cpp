#include "optimizer/candidate/matrices.hpp"

#include <span>
#include <utility>

#include "fem/stress.hpp"
#include "optimizer/candidate/contact_nodes.hpp"
#include "optimizer/candidate/stopwatch.hpp"
#include "optimizer/scene/scene_kind.hpp"
#include "reduction/static_condensation.hpp"
#include "steady/preload.hpp"
#include "steady/work.hpp"

namespace dovetail::optimizer {

namespace {

/// The preload that the prestress comes from: on matched flanks with a friction that all designs share, or the design's
/// own.
struct Nominal {
  ContactProperties contact;
  Eigen::VectorXd gap;  ///< of contact nodes
};

Nominal nominal(const Scene& scene, const fem::ContactCells& cells, double friction) {
  Nominal result{.contact = scene.contact, .gap = cells.gap};
  if (scene.solver.prestress == Prestress::own) return result;
  result.contact.friction = friction;
  result.gap.setZero();
  return result;
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

/// As much work as an evaluation may take besides.
SharedBudget budget(const SolverSettings& solver, Eigen::Index nodes, Eigen::Index directions) {
  const double jacobian = steady::jacobian_operations(nodes, directions, solver.harmonics, solver.samples);
  return std::make_shared<Budget>(solver.max_jacobians > 0 ? solver.max_jacobians * jacobian : kInfinity,
                                  solver.time_limit > 0 ? solver.time_limit : kInfinity);
}

/// Geometric stiffness from the stresses of a frictional preload: glued flanks would carry tension.
Status geometric_stiffness(const Scene& scene, const fem::SectorMesh& sector, const fem::ContactCells& cells,
                           const Nominal& nominal, const fem::Assembler& assembler, const fem::SectorSystem& system,
                           Eigen::SparseMatrix<double>& result) {
  reduction::ContactNodes nodes = contact_nodes(cells, 0, nominal.contact);
  nodes.gap = nominal.gap;
  reduction::StaticCondensation condensed = reduction::on_contact(
      reduction::condense_statically(full_model(scene, system, system.full.stiffness)), cells.average, nodes);
  if (condensed.status != Status::converged) return condensed.status;
  reduction::add_interface(interface_of(nominal.contact), condensed.model, &condensed.recovery);
  const auto model = std::make_shared<const dynamics::CondensedModel>(condensed.model);
  const steady::Preload preload =
      steady::quasi_static(model, {.budget = budget(scene.solver, cells.count(), system.full.dimensions)});
  if (preload.status != Status::converged) return preload.status;
  const Eigen::VectorXd independent = condensed.recovery.apply(preload.full_displacement, preload.force);
  const Eigen::VectorXd displacement = system.constraints.transformation * independent;
  result =
      assembler.geometric_stiffness(sector.mesh, fem::quadrature_stress(sector.mesh, materials(scene), displacement));
  return Status::converged;
}

Matrices computed(const Scene& scene, const fem::SectorMesh& sector, const fem::ContactCells& cells,
                  const Nominal& nominal, std::map<std::string, double>& timings_s) {
  Matrices result;
  Stopwatch watch;
  const std::vector<fem::Material> bodies = materials(scene);
  const fem::Assembler assembler(sector.mesh);
  result.system = fem::build_sector_system(sector, bodies, assembler);
  timings_s["assembly"] = watch.lap();

  Eigen::SparseMatrix<double> geometric;
  const Status prestress = geometric_stiffness(scene, sector, cells, nominal, assembler, result.system, geometric);
  timings_s["prestress"] = watch.lap();
  if (prestress != Status::converged) {
    result.status = failed_at("prestress", prestress);
    return result;
  }

  result.stiffness = fem::stiffness_at_speed(result.system.full, geometric, scene.loading.speed);
  result.trace = reduction::trace_model(full_model(scene, result.system, result.stiffness),
                                        {.modes = scene.solver.modes, .damping_ratio = scene.loading.damping_ratio});
  timings_s["reduction"] = watch.lap();
  if (result.trace.status != Status::converged)
    result.status = failed_at("reduction", result.trace.status) + " " + result.trace.message;
  return result;
}

MatricesOf asked_for(const Scene& scene, const fem::SectorMesh& sector, const Nominal& nominal) {
  std::vector<double> numbers{scene.loading.speed,
                              scene.loading.tip_force,
                              scene.loading.damping_ratio,
                              static_cast<double>(scene.solver.modes),
                              nominal.contact.friction,
                              nominal.contact.normal_stiffness,
                              nominal.contact.tangential_stiffness,
                              static_cast<double>(sector.sectors)};
  for (const fem::Material& body : materials(scene))
    numbers.insert(numbers.end(), {body.youngs_modulus, body.poisson_ratio, body.density});
  for (const fem::Region& region : sector.mesh.regions) numbers.push_back(region.thickness);
  numbers.insert(numbers.end(), nominal.gap.begin(), nominal.gap.end());
  return {.nodes = sector.mesh.nodes,
          .connectivity = sector.mesh.connectivity,
          .region = sector.mesh.region,
          .numbers = std::move(numbers)};
}

}  // namespace

bool MatricesOf::operator==(const MatricesOf& other) const {
  return numbers == other.numbers && connectivity == other.connectivity && region == other.region &&
         nodes.rows() == other.nodes.rows() && nodes.cols() == other.nodes.cols() && nodes == other.nodes;
}

std::shared_ptr<const Matrices> MatricesStore::matrices(const Scene& scene, const fem::SectorMesh& sector,
                                                        const fem::ContactCells& cells,
                                                        std::map<std::string, double>& timings_s) {
  const Nominal by = nominal(scene, cells, friction_);
  MatricesOf asked = asked_for(scene, sector, by);
  {
    const std::lock_guard lock(mutex_);
    if (last_ && of_ == asked) return last_;
    last_.reset();  // before the next ones are there: both need not fit into memory
  }
  auto result = std::make_shared<const Matrices>(computed(scene, sector, cells, by, timings_s));
  const std::lock_guard lock(mutex_);
  of_ = std::move(asked);
  last_ = result;
  return result;
}

}  // namespace dovetail::optimizer
