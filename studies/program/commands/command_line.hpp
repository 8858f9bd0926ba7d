#pragma once

#include "studies/program/commands/commands.hpp"

namespace dovetail::studies {

/// The program: parses the arguments, runs the command, tells errors in sentences on `err`. Returns the exit status:
/// 0 done, 2 wrong input, 3 not converged, 130 interrupted.
/// @param pools  who works on the pieces of a run
int run_program(int argc, const char* const* argv, const Streams& streams, const PoolFactory& pools = processes);

}  // namespace dovetail::studies
