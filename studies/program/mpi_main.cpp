// The program on many machines: `mpirun -n N dovetail-mpi run STUDY -o DIR`. The first rank is the program, and hands
// the pieces of a run out to the others.
#include <fmt/format.h>
#include <mpi.h>

#include <csignal>
#include <iostream>
#include <memory>

#include "numerics/process.hpp"
#include "optimizer/workers/mpi_pool.hpp"
#include "studies/program/commands/command_line.hpp"
#include "studies/program/engine/engine.hpp"
#include "studies/program/engine/interrupt.hpp"
#include "studies/program/engine/pieces.hpp"

int main(int argc, char** argv) {
  using namespace dovetail;
  numerics::prepare_process(argv);
  int threads = 0;  // only the first of them speaks to others
  MPI_Init_thread(&argc, &argv, MPI_THREAD_FUNNELED, &threads);
  int rank = 0, ranks = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MPI_Comm_size(MPI_COMM_WORLD, &ranks);
  int status = 0;
  if (rank > 0) {
    std::signal(SIGINT, SIG_IGN);  // the first rank ends in order, and them
    optimizer::serve(studies::workers_with(studies::study_engine));
  } else {
    studies::install_interrupt_handler();
    status = studies::run_program(argc, argv, {.out = std::cout, .err = std::cerr},
                                  [ranks](const studies::RunOptions& options,
                                          const optimizer::WorkerFactory&) -> std::unique_ptr<optimizer::WorkerPool> {
                                    if (ranks == 1) return nullptr;
                                    std::cerr << fmt::format("dovetail: {} ranks work at once\n", ranks - 1)
                                              << std::flush;
                                    return std::make_unique<optimizer::MpiPool>(options.patience);
                                  });
    optimizer::dismiss();
  }
  MPI_Finalize();
  return status;
}
