#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <string>
#include <vector>

#include "studies/program/commands/commands.hpp"

namespace dovetail::studies {

/// Options as CLI11 stores them, and the command chosen.
struct Arguments {
  CheckOptions check;
  NewOptions create;
  EvaluateOptions evaluate;
  ReduceOptions reduce;
  ResponseOptions response;
  BackboneOptions backbone;
  WearOptions wear;
  RunOptions run;
  ImportOptions import;
  ExportOptions geometry;
  ReportOptions report;
  SolverOverrides solver;
  std::vector<std::string> set;
  std::function<int(const Streams&)> command;

  /// Those given with --set. Throws InputError with all that are not KEY=VALUE.
  [[nodiscard]] std::vector<Override> overrides() const;
};

/// Adds every command with its options and help; parsing then fills `arguments`, which must outlive the app.
void define_commands(CLI::App& app, Arguments& arguments);

}  // namespace dovetail::studies
