#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "studies/program/arguments.hpp"

/// Options that several commands have, and the groups of commands that arguments.cpp puts together.
namespace dovetail::studies {

void add_set(CLI::App& command, Arguments& arguments);
void add_json(CLI::App& command, std::string& json);
/// Harmonics, samples, tolerance, pseudo-penalties and solver.
void add_solver(CLI::App& command, Arguments& arguments);

/// response, backbone and wear.
void define_model_commands(CLI::App& app, Arguments& arguments);

}  // namespace dovetail::studies
