#include <iostream>

#include "numerics/process.hpp"
#include "studies/program/commands/command_line.hpp"
#include "studies/program/engine/interrupt.hpp"

int main(int argc, char** argv) {
  dovetail::numerics::prepare_process(argv);
  dovetail::studies::install_interrupt_handler();
  return dovetail::studies::run_program(argc, argv, {.out = std::cout, .err = std::cerr});
}
