#include "optimizer/candidate/matrices_store.hpp"

#include <utility>

#include "optimizer/candidate/stopwatch.hpp"

namespace dovetail::optimizer {

namespace {

std::shared_ptr<const Matrices> computed(MatricesStages stages, const Matrices* same,
                                         std::map<std::string, double>& timings_s) {
  Stopwatch watch;
  if (same != nullptr) {
    stages.go_on_from(*same);
  } else {
    stages.assemble();
    timings_s["assembly"] = watch.lap();
    stages.add_prestress();
    if (outcome_of(stages.matrices()->status) != Outcome::converged) return stages.matrices();
    timings_s["prestress"] = watch.lap();
  }
  stages.reduce();
  timings_s["reduction"] = watch.lap();
  return stages.matrices();
}

PreloadOf preload_of(const Scene& scene, const fem::ContactCells& cells) {
  const ContactProperties& contact = scene.contact;
  const SolverSettings& solver = scene.solver;
  PreloadOf result{.numbers = {contact.friction, contact.normal_stiffness, contact.tangential_stiffness,
                               static_cast<double>(solver.max_jacobians), solver.time_limit,
                               static_cast<double>(solver.harmonics), static_cast<double>(solver.samples)},
                   .flanks = cells.flanks};
  result.numbers.insert(result.numbers.end(), cells.gap.begin(), cells.gap.end());
  return result;
}

MatricesOf asked_for(const Scene& scene, const fem::SectorMesh& sector, const PreloadedContact& by) {
  std::vector<double> numbers{scene.loading.speed,
                              by.contact.friction,
                              by.contact.normal_stiffness,
                              by.contact.tangential_stiffness,
                              static_cast<double>(scene.solver.prestress),
                              static_cast<double>(sector.sectors)};
  for (const fem::Material& body : materials(scene))
    numbers.insert(numbers.end(), {body.youngs_modulus, body.poisson_ratio, body.density});
  for (const fem::Region& region : sector.mesh.regions) numbers.push_back(region.thickness);
  numbers.insert(numbers.end(), by.gap.begin(), by.gap.end());
  return {.nodes = sector.mesh.nodes,
          .connectivity = sector.mesh.connectivity,
          .region = sector.mesh.region,
          .numbers = std::move(numbers),
          .modes = scene.solver.modes};
}

}  // namespace

bool MatricesOf::same_but_modes(const MatricesOf& other) const {
  return numbers == other.numbers && connectivity == other.connectivity && region == other.region &&
         nodes.rows() == other.nodes.rows() && nodes.cols() == other.nodes.cols() && nodes == other.nodes;
}

DesignMatrices MatricesStore::matrices(const Scene& asked, const fem::SectorMesh& sector,
                                       const fem::ContactCells& cells, std::map<std::string, double>& timings_s) {
  Scene scene = asked;
  scene.solver.prestress = prestress_of(asked, sector);
  std::shared_ptr<const Matrices> same = shared(scene, sector, cells, timings_s);
  Stopwatch watch;
  if (scene.solver.prestress != Prestress::shared) return of_design(scene, sector, cells, std::move(same));
  DesignMatrices result = changed(scene, sector, cells, same);
  timings_s["prestress"] += watch.lap();
  return result;
}

DesignMatrices MatricesStore::changed(const Scene& scene, const fem::SectorMesh& sector, const fem::ContactCells& cells,
                                      const std::shared_ptr<const Matrices>& shared) {
  PreloadOf preload = preload_of(scene, cells);
  PreloadChange known;
  {
    const std::lock_guard lock(mutex_);
    if (changed_.lock() == shared && preload_ == preload) known = change_;
  }
  DesignMatrices result = of_design(scene, sector, cells, shared, known);
  if (outcome_of(result.status) != Outcome::converged || known.on_trace) return result;
  const std::lock_guard lock(mutex_);
  changed_ = shared;
  preload_ = std::move(preload);
  change_ = {.stiffness = result.change, .on_trace = result.trace.change};
  return result;
}

KeptPatterns MatricesStore::patterns(const fem::Mesh& mesh) {
  const std::lock_guard lock(mutex_);
  if (!patterns_.assembler || !patterns_.assembler->serves(mesh))
    patterns_.assembler = std::make_shared<const fem::Assembler>(mesh);
  return patterns_;
}

std::shared_ptr<const Matrices> MatricesStore::shared(const Scene& scene, const fem::SectorMesh& sector,
                                                      const fem::ContactCells& cells,
                                                      std::map<std::string, double>& timings_s) {
  const PreloadedContact by = stressed(scene, cells, friction_);
  MatricesOf asked = asked_for(scene, sector, by);
  std::shared_ptr<const Matrices> same;  // but for the modes
  {
    const std::lock_guard lock(mutex_);
    if (last_ && of_.same_but_modes(asked)) {
      if (of_.modes == asked.modes) return last_;
      if (outcome_of(last_->status) == Outcome::converged) same = last_;
    }
    last_.reset();  // before the next ones are there: both need not fit into memory, unless one goes on from the other
  }
  std::shared_ptr<const Matrices> result =
      computed({scene, sector, cells, by, patterns(sector.mesh)}, same.get(), timings_s);
  const std::lock_guard lock(mutex_);
  of_ = std::move(asked);
  last_ = result;
  return result;
}

}  // namespace dovetail::optimizer
