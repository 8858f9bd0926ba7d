#include <iostream>

#include "studies/program/command_line.hpp"
#include "studies/program/interrupt.hpp"

int main(int argc, char** argv) {
  dovetail::studies::install_interrupt_handler();
  return dovetail::studies::run_program(argc, argv, {.out = std::cout, .err = std::cerr});
}
