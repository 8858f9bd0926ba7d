#include "studies/program/commands/shared_arguments.hpp"

#include "optimizer/scene/scene.hpp"

namespace dovetail::studies {
namespace {

/// A whole number, or the word auto.
void add_automatic(CLI::App& command, const char* name, std::optional<int>& value, bool& automatic, const char* help,
                   const char* type) {
  command
      .add_option_function<std::string>(
          name,
          [name, &value, &automatic](const std::string& text) {
            automatic = text == "auto";
            int number = 0;
            if (!automatic && !CLI::detail::lexical_cast(text, number))
              throw CLI::ValidationError(name, "must be a whole number or auto, not " + text);
            if (!automatic) value = number;
          },
          help)
      ->type_name(type);
}

}  // namespace

void add_set(CLI::App& command, Arguments& a) {
  command
      .add_option("--set", a.set,
                  "Replace a value of the study file before it is checked, e.g. --set geometry.neck_width_mm=9; may be "
                  "repeated")
      ->type_name("KEY=VALUE")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
      ->allow_extra_args(false);
}

void add_json(CLI::App& command, std::string& json) {
  command
      .add_option("--json", json,
                  "Write the answer as JSON to FILE; - is standard output, and then nothing else goes there")
      ->type_name("FILE");
}

void add_solver(CLI::App& command, Arguments& a) {
  SolverOverrides& solver = a.solver;
  add_automatic(command, "--harmonics", solver.harmonics, solver.automatic_harmonics,
                "Harmonics of the periodic motion; auto: as many as the error bars ask for", "H|auto");
  add_automatic(command, "--samples", solver.samples, solver.automatic_samples,
                "Instants per period at which the contact is marched; auto: as many as the error bars ask for",
                "N|auto");
  command
      .add_option("--accuracy", solver.accuracy,
                  "Relative error bar of amplitudes that auto has to reach, of energies ten times that (default: 1e-3)")
      ->type_name("A");
  command.add_option("--tolerance", solver.tolerance, "Relative residual at which a steady state counts as converged")
      ->type_name("T");
  command
      .add_option("--pseudo-penalty", solver.pseudo_penalty,
                  "Pseudo-penalty of all contact nodes, N/m (default, and 0: from the model, the local contact "
                  "stiffness)")
      ->type_name("E");
  command
      .add_option("--pseudo-penalty-normal", solver.pseudo_penalty_normal,
                  "The same for the normal direction alone (default, and 0: that of --pseudo-penalty)")
      ->type_name("E");
  std::vector<std::string> solvers;
  for (const std::string_view choice : optimizer::find_parameter("solver.solver")->choices)
    solvers.emplace_back(choice);
  command
      .add_option("--solver", solver.solver,
                  "auto: Newton, then other pseudo-penalties and Powell where it fails; newton; powell: hybrid Powell "
                  "with the exact Jacobian; powell_fd: with finite differences, for comparison")
      ->type_name("NAME")
      ->check(CLI::IsMember(solvers));
}

}  // namespace dovetail::studies
