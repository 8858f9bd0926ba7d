#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "studies/program/commands/arguments.hpp"

/// Options that several commands have, and the groups of commands that arguments.cpp puts together.
namespace dovetail::studies {

void add_set(CLI::App& command, Arguments& arguments);
void add_json(CLI::App& command, std::string& json);
/// Harmonics, samples, tolerance, pseudo-penalties and solver.
void add_solver(CLI::App& command, Arguments& arguments);

/// What `command` does when it is chosen: `run(options, streams)`, with what --set and the solver's options say.
template <class Options, class Run>
void runs(CLI::App& command, Arguments& arguments, Options& options, Run run) {
  command.callback([&arguments, &options, run] {
    arguments.command = [&arguments, &options, run](const Streams& streams) {
      if constexpr (requires { options.overrides; }) options.overrides = arguments.overrides();
      if constexpr (requires { options.solver; }) options.solver = arguments.solver;
      return run(options, streams);
    };
  });
}

/// response, backbone and wear.
void define_model_commands(CLI::App& app, Arguments& arguments);

}  // namespace dovetail::studies
