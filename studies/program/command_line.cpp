#include "studies/program/command_line.hpp"

#include <CLI/CLI.hpp>
#include <exception>
#include <ostream>
#include <sstream>
#include <system_error>

#include "studies/program/arguments.hpp"
#include "studies/program/version.hpp"

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

std::string one_line(std::string text) {
  for (char& c : text)
    if (c == '\n' || c == '\r') c = ' ';
  return text;
}

/// Help and version are answers; everything else CLI11 complains about is one line.
int parse_failure(const CLI::App& app, const CLI::ParseError& error, const Streams& streams) {
  std::ostringstream answer, ignored;
  if (error.get_exit_code() == static_cast<int>(CLI::ExitCodes::Success)) {
    app.exit(error, answer, ignored);
    streams.out << answer.str();
    return kDone;
  }
  std::string command;
  for (const CLI::App* chosen : app.get_subcommands()) command = " " + chosen->get_name();
  streams.err << "dovetail" << command << ": " << one_line(error.what()) << "; see dovetail" << command << " --help\n";
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
    return parse_failure(app, error, streams);
  }
  try {
    return arguments.command(streams);
  } catch (const InputError& error) {
    streams.err << error.what() << "\n";
    return kWrongInput;
  } catch (const std::system_error& error) {
    streams.err << "dovetail: " << one_line(error.what()) << "\n";
    return kWrongInput;
  } catch (const std::exception& error) {
    streams.err << "dovetail: the computation ended unexpectedly: " << one_line(error.what()) << "\n";
    return kNotConverged;
  }
}

}  // namespace dovetail::studies
