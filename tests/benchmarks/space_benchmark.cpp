// The linear chain in space on structured toothed sectors of growing size: assembly, one factorisation, back-solves,
// glued modes, and the reduction to contact dofs against the factorisation and back-solves it cannot do without. Times
// of one run, seconds; growth is the slope of log time over log dofs between the two largest meshes.
//   build/tests/benchmarks/space_benchmark [largest = 9]
#include <sys/resource.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <vector>

#include "fem/glued_modes.hpp"
#include "numerics/blas.hpp"
#include "reduction/massless_boundary.hpp"
#include "tests/unit/fem/extruded_mesh.hpp"
#include "tests/unit/fem/internal_block.hpp"
#include "tests/unit/fem/structured_mesh.hpp"
#include "tests/verification/fem/sector_model.hpp"

namespace {

using namespace dovetail;

class Stopwatch {
 public:
  double lap() {
    const Clock::time_point now = Clock::now();
    const double seconds = std::chrono::duration<double>(now - start_).count();
    start_ = now;
    return seconds;
  }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point start_ = Clock::now();
};

double peak_gib() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / (1 << 20);
}

struct Row {
  double dofs, pattern, assembly, constrained, factorisation, solve_one, solve_contact, modes, reduction;
};

Row measure(int size) {
  fem::SectorMesh plane = fem::testing::toothed_sector(2 * size / 3, size, size, 47, false);
  for (fem::Region& region : plane.mesh.regions) region.plane_stress = false;
  fem::SectorMesh sector = fem::testing::extrude(plane, size, 0.04, size + 1);
  for (int node : sector.bore_nodes)
    if (std::abs(sector.mesh.nodes(2, node) - 0.02) < 1e-9) sector.axial_nodes.push_back(node);
  const std::vector<fem::Material> materials(2);

  Row row{};
  Stopwatch watch;
  const fem::Assembler assembler(sector.mesh);
  row.pattern = watch.lap();
  const fem::FullMatrices matrices = assembler.stiffness_and_mass(sector.mesh, materials);
  row.assembly = watch.lap();
  const fem::SectorSystem system = fem::build_sector_system(sector, materials, assembler);
  row.constrained = watch.lap() - row.assembly;
  reduction::FullModel full = fem::testing::sector_model(system, 1000, 0.3);
  row.dofs = static_cast<double>(full.size());

  watch.lap();
  {
    const Eigen::SparseMatrix<double> interior = fem::internal_block(full.stiffness, system.constraints);
    watch.lap();
    numerics::SparseCholesky<double> cholesky;
    if (cholesky.factorise(interior) != Status::converged) std::exit(1);
    row.factorisation = watch.lap();
    Eigen::VectorXd one = Eigen::VectorXd::Ones(interior.rows());
    for (int k = 0; k < 10; ++k) cholesky.solve(one.data(), one.data());
    row.solve_one = watch.lap() / 10;
    const Eigen::MatrixXd loads = full.stiffness.topRightCorner(interior.rows(), full.contact_size());
    watch.lap();
    const Eigen::MatrixXd responses = cholesky.solve(loads);
    row.solve_contact = watch.lap();
    std::printf("%8.0f %6d %7.0f %6.2f %6.2f %6.2f %6.2f %7.4f %6.2f", row.dofs, static_cast<int>(full.contact.count()),
                cholesky.factor_entries() / 1e6, row.pattern, row.assembly, row.constrained, row.factorisation,
                row.solve_one, row.solve_contact);
    std::fflush(stdout);
    watch.lap();
    const auto modes = fem::glued_modes(matrices.stiffness, matrices.mass, system.constraints, {.count = 20}, cholesky);
    if (modes.status != Status::converged) std::exit(1);
    row.modes = watch.lap();
  }
  const double before = peak_gib();
  watch.lap();
  const reduction::Reduction reduced = reduction::reduce(full, {.modes = 20});
  row.reduction = watch.lap();
  if (reduced.status != Status::converged) std::printf(" %s", reduced.message.c_str());
  const double needed = row.factorisation + row.solve_contact;
  std::printf(" %6.2f %6.2f (%.2f factor, %.2f contact, %.2f modes) %5.2f %5.2f %5.2f\n", row.modes, row.reduction,
              reduced.seconds_factorisation, reduced.seconds_contact_solves, reduced.seconds_modes,
              row.reduction / needed, before, peak_gib());
  return row;
}

}  // namespace

int main(int count, char** arguments) {
  dovetail::numerics::prepare_blas(arguments);
  const int largest = count > 1 ? std::atoi(arguments[1]) : 9;
  std::printf(
      "    dofs  nodes L(1e6) pattrn assemb constr factor  solve1 solveC  modes reduce (stages) "
      "reduce/(factor+solveC) GiB before, after\n");
  std::vector<Row> rows;
  for (int size = 3; size <= largest; size += 2) rows.push_back(measure(size));
  if (rows.size() < 2) return 0;
  const Row &a = rows[rows.size() - 2], &b = rows.back();
  const auto slope = [&](double Row::*time) { return std::log(b.*time / (a.*time)) / std::log(b.dofs / a.dofs); };
  std::printf("growth: assembly %.2f, factorisation %.2f, one solve %.2f, modes %.2f, reduction %.2f\n",
              slope(&Row::assembly), slope(&Row::factorisation), slope(&Row::solve_one), slope(&Row::modes),
              slope(&Row::reduction));
  return 0;
}
