// The linear stages and the memory of the bladed disk of the reference in space on four meshes of the same geometry and
// contact grid. Each in a process of its own, so that peak memory is its own; `load` is that of the machine before the
// run, `cpu` the process's time whatever that is. Stages one by one: stage_benchmark.
//   build/tests/benchmarks/sector_benchmark
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <vector>

#include "numerics/process.hpp"
#include "optimizer/candidate/candidate_model.hpp"
#include "studies/program/study_file/study.hpp"

namespace {

using namespace dovetail;

struct Size {
  int flank, aerofoil, slot;
  double fillet, bulk, blend, growth;
};

/// 7 x 8 contact nodes per flank whatever the mesh: 112.
optimizer::Scene scene_of(const Size& size) {
  optimizer::Scene scene = studies::load_study(BLADED_DISK).scene;
  scene.mesh = {.flank_elements = size.flank,
                .fillet_fraction = size.fillet,
                .bulk_size = size.bulk,
                .aerofoil_elements = size.aerofoil,
                .blend_fraction = size.blend,
                .growth = size.growth};
  scene.solid_mesh.slot_elements = size.slot;
  scene.solid_mesh.contact_flank_elements = 6;
  scene.solid_mesh.contact_slot_elements = 7;
  return scene;
}

double cpu_seconds() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const auto seconds = [](const timeval& time) {
    return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

double peak_gib() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / (1 << 20);
}

void print_load() {
  std::array<double, 1> load{};
  if (getloadavg(load.data(), 1) == 1) std::printf("load %.1f\n", load[0]);
}

struct Row {
  double dofs = 0, assembly = 0, prestress = 0, reduction = 0, factorisation = 0, contact_solves = 0, modes = 0,
         cpu = 0, memory = 0;
};

/// Runs `measure` in a child process and returns what it measured; zeros when it fails.
Row in_own_process(const std::function<Row()>& measure) {
  std::array<int, 2> ends{};
  if (pipe(ends.data()) != 0) return {};
  std::fflush(stdout);
  const pid_t child = fork();
  if (child == 0) {
    const Row row = measure();
    std::fflush(stdout);
    _exit(write(ends[1], &row, sizeof row) == sizeof row ? 0 : 1);
  }
  close(ends[1]);
  Row row;
  if (read(ends[0], &row, sizeof row) != sizeof row) row = {};
  close(ends[0]);
  waitpid(child, nullptr, 0);
  return row;
}

constexpr std::array<Size, 4> kSizes{
    {{.flank = 6, .aerofoil = 4, .slot = 7, .fillet = 1.0, .bulk = 20e-3, .blend = 1, .growth = 1},
     {.flank = 6, .aerofoil = 8, .slot = 7, .fillet = 0.7, .bulk = 15e-3, .blend = 0.8, .growth = 0.4},
     {.flank = 8, .aerofoil = 10, .slot = 8, .fillet = 0.7, .bulk = 10e-3, .blend = 0.8, .growth = 0.4},
     {.flank = 8, .aerofoil = 10, .slot = 10, .fillet = 0.5, .bulk = 8e-3, .blend = 0.7, .growth = 0.4}}};
Row linear_stages(const Size& size) {
  const optimizer::Scene scene = scene_of(size);
  const optimizer::CandidateModel model = optimizer::ModelBuilder(scene).build(scene);
  if (!model.converged()) {
    std::printf("%s\n", model.status.c_str());
    return {};
  }
  return {.dofs = model.sizes.at("dofs"),
          .assembly = model.timings_s.at("assembly"),
          .prestress = model.timings_s.at("prestress"),
          .reduction = model.timings_s.at("reduction"),
          .factorisation = model.reduction.seconds_factorisation,
          .contact_solves = model.reduction.seconds_contact_solves,
          .modes = model.reduction.seconds_modes,
          .cpu = cpu_seconds(),
          .memory = peak_gib()};
}

/// Slope of the straight line through log y over log dofs.
double exponent(const std::vector<Row>& rows, double Row::*y) {
  double mean_x = 0, mean_y = 0, xx = 0, xy = 0;
  for (const Row& row : rows) {
    mean_x += std::log(row.dofs) / static_cast<double>(rows.size());
    mean_y += std::log(row.*y) / static_cast<double>(rows.size());
  }
  for (const Row& row : rows) {
    xx += std::pow(std::log(row.dofs) - mean_x, 2);
    xy += (std::log(row.dofs) - mean_x) * (std::log(row.*y) - mean_y);
  }
  return xy / xx;
}

void growth() {
  std::printf(
      "    dofs assembly prestress reduction (factor, contact, modes) reduction/(factor + contact)  cpu, all  GiB\n");
  std::vector<Row> rows;
  for (const Size& size : kSizes) {
    const Row row = in_own_process([&] { return linear_stages(size); });
    if (row.dofs == 0) continue;
    std::printf("%8.0f %8.2f %9.2f %9.2f (%.2f, %.2f, %.2f) %.2f %6.2f %5.2f\n", row.dofs, row.assembly, row.prestress,
                row.reduction, row.factorisation, row.contact_solves, row.modes,
                row.reduction / (row.factorisation + row.contact_solves), row.cpu, row.memory);
    rows.push_back(row);
  }
  if (rows.size() < 2) return;
  std::printf("exponents: assembly %.2f, prestress %.2f, reduction %.2f, factorisation %.2f, cpu %.2f, memory %.2f\n",
              exponent(rows, &Row::assembly), exponent(rows, &Row::prestress), exponent(rows, &Row::reduction),
              exponent(rows, &Row::factorisation), exponent(rows, &Row::cpu), exponent(rows, &Row::memory));
}

}  // namespace

int main(int, char** arguments) {
  dovetail::numerics::prepare_process(arguments);
  print_load();
  growth();
  return 0;
}
