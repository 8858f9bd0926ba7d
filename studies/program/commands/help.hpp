#pragma once

#include <string>

namespace dovetail::studies {

/// What the help says of a command besides its options.
struct CommandHelp {
  std::string name, what, footer = {};
};

/// Texts of the program's help.
namespace help {

inline constexpr const char* kDescription =
    "dovetail optimises blade attachments (dovetails) of bladed disks for little fretting wear: from a section's\n"
    "dimensions over finite elements and a reduced model to the vibration with friction, the shape at which wear\n"
    "comes to rest, and the best design.\n\n"
    "A session:\n"
    "  dovetail new mine.toml         write a commented study to start from\n"
    "  dovetail check mine.toml       is everything in it valid?\n"
    "  dovetail evaluate mine.toml    compute the one design it describes\n"
    "  dovetail run mine.toml         optimise it; results go to results/mine";

inline constexpr const char* kFooter =
    "Exit status: 0 done; 2 the input is wrong (each error is a sentence on standard error); 3 a computation did not\n"
    "converge (what did converge is still written); 130 interrupted, with everything finished so far kept.\n"
    "`dovetail COMMAND --help` explains a command.";

[[nodiscard]] CommandHelp run();
[[nodiscard]] CommandHelp evaluate();
[[nodiscard]] CommandHelp reduce();
[[nodiscard]] CommandHelp check();
[[nodiscard]] CommandHelp create();
[[nodiscard]] CommandHelp materials();
[[nodiscard]] CommandHelp response();
[[nodiscard]] CommandHelp backbone();
[[nodiscard]] CommandHelp wear();
[[nodiscard]] CommandHelp import_model();
[[nodiscard]] CommandHelp export_files();
[[nodiscard]] CommandHelp runs();
[[nodiscard]] CommandHelp serve();
[[nodiscard]] CommandHelp schema();
[[nodiscard]] CommandHelp completion();
[[nodiscard]] CommandHelp merge();
[[nodiscard]] CommandHelp report();

}  // namespace help

}  // namespace dovetail::studies
