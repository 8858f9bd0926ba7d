#include <malloc.h>

#include <iostream>

#include "numerics/process.hpp"
#include "studies/program/commands/command_line.hpp"
#include "studies/program/engine/interrupt.hpp"

int main(int argc, char** argv) {
  dovetail::numerics::prepare_process(argv);
  // Jacobians of tens of megabytes come and go in every iteration: memory given back to the system each time would have
  // to be mapped page by page again, which takes longer than filling it.
  constexpr int kKept = 1 << 30;
  ::mallopt(M_MMAP_THRESHOLD, kKept);
  ::mallopt(M_TRIM_THRESHOLD, kKept);
  dovetail::studies::install_interrupt_handler();
  return dovetail::studies::run_program(argc, argv, {.out = std::cout, .err = std::cerr});
}
