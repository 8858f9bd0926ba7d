#include "studies/program/commands/command_line.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <exception>
#include <new>
#include <ostream>
#include <sstream>
#include <system_error>

#include "core/options.hpp"
#include "studies/program/commands/arguments.hpp"
#include "studies/program/commands/version.hpp"

namespace dovetail::studies {
namespace {

constexpr const char* kDescription =
    "dovetail optimises blade attachments (dovetails) of bladed disks for little fretting wear: from a section's\n"
    "dimensions over finite elements and a reduced model to the vibration with friction, the shape at which wear\n"
    "comes to rest, and the best design.\n\n"
    "A session:\n"
    "  dovetail new mine.toml         write a commented study to start from\n"
    "  dovetail check mine.toml       is everything in it valid?\n"
    "  dovetail evaluate mine.toml    compute the one design it describes\n"
    "  dovetail run mine.toml         optimise it; results go to results/mine";

constexpr const char* kFooter =
    "Exit status: 0 done; 2 the input is wrong (each error is a sentence on standard error); 3 a computation did not\n"
    "converge (what did converge is still written); 130 interrupted, with everything finished so far kept.\n"
    "`dovetail COMMAND --help` explains a command.";

/// What to say of a first word that is no command; empty when it is one.
std::string unknown_command(const CLI::App& app, const std::string& word) {
  std::vector<std::string> commands;
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; }))
    commands.push_back(command->get_name());
  if (std::find(commands.begin(), commands.end(), word) != commands.end()) return {};
  const std::string near = nearest(word, commands);
  return "unknown command " + one_line(word) + (near.empty() ? "" : "; did you mean " + near + "?");
}

/// Help and version are answers; everything else CLI11 complains about is one line. `word` is the first argument.
int parse_failure(const CLI::App& app, const CLI::ParseError& error, const std::string& word, const Streams& streams) {
  std::ostringstream answer, ignored;
  if (error.get_exit_code() == static_cast<int>(CLI::ExitCodes::Success)) {
    app.exit(error, answer, ignored);
    streams.out << answer.str();
    return kDone;
  }
  std::string command;
  for (const CLI::App* chosen : app.get_subcommands()) command = " " + chosen->get_name();
  std::string complaint = word.empty() || word.starts_with("-") ? "" : unknown_command(app, word);
  if (complaint.empty()) complaint = one_line(error.what());
  streams.err << "dovetail" << command << ": " << complaint << "; see dovetail" << command << " --help\n";
  return kWrongInput;
}

}  // namespace

int run_program(int argc, const char* const* argv, const Streams& streams) {
  CLI::App app(kDescription, "dovetail");
  Arguments arguments;
  app.set_version_flag("--version", std::string("dovetail ") + version());
  app.require_subcommand(1);
  app.footer(kFooter);
  define_commands(app, arguments);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return parse_failure(app, error, argc > 1 ? argv[1] : "", streams);
  }
  try {
    return arguments.command(streams);
  } catch (const InputError& error) {
    streams.err << error.what() << "\n";
    return kWrongInput;
  } catch (const std::system_error& error) {
    streams.err << "dovetail: " << one_line(error.what()) << "\n";
    return kWrongInput;
  } catch (const std::bad_alloc&) {
    streams.err << "dovetail: there is not enough memory for this; fewer harmonics, samples, modes or elements need "
                   "less\n";
    return kWrongInput;
  } catch (const std::exception& error) {
    streams.err << "dovetail: the computation ended unexpectedly: " << one_line(error.what()) << "\n";
    return kNotConverged;
  }
}

}  // namespace dovetail::studies
