#include "studies/program/arguments.hpp"

#include "optimizer/scene.hpp"
#include "studies/program/engine.hpp"
#include "studies/program/export.hpp"

namespace dovetail::studies {
namespace {

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

CLI::Option* add_study(CLI::App& command, std::string& study) {
  return command.add_option("STUDY", study, "The study file (TOML)")->required()->type_name("");
}

void define_study_commands(CLI::App& app, Arguments& a) {
  CLI::App* run = app.add_subcommand("run", "Optimise a study");
  run->footer(
      "The directory gets journal.jsonl (every evaluation, appended as it finishes), best.toml (a study file that\n"
      "evaluates to the best design), results.h5, report.html and the exports the study asks for. Ctrl-C ends the run\n"
      "in order; `--resume` continues it: stored evaluations are not computed again.");
  add_study(*run, a.run.study);
  run->add_option("-o,--output", a.run.directory, "Directory of the results (default: results/NAME)")->type_name("DIR");
  run->add_flag("--resume", a.run.resume, "Continue the run stored in the directory");
  run->callback([&a] { a.command = [&a](const Streams& s) { return run_study(a.run, s, study_engine); }; });

  CLI::App* evaluate = app.add_subcommand("evaluate", "Compute one design: all responses with error estimates");
  evaluate->footer(
      "JSON: {\"status\", \"feasible\", \"parameters\", \"responses\", \"constraints\", \"error_estimates\", "
      "\"model\",\n"
      "\"timings_s\", \"messages\"}; parameters in the study file's units, all else SI; constraints hold when <= 0.");
  add_study(*evaluate, a.evaluate.study);
  add_set(*evaluate, a);
  add_solver(*evaluate, a);
  add_json(*evaluate, a.evaluate.json);
  evaluate->callback([&a] {
    a.command = [&a](const Streams& s) {
      a.evaluate.overrides = a.overrides();
      a.evaluate.solver = a.solver;
      return run_evaluate(a.evaluate, s);
    };
  });

  CLI::App* reduce = app.add_subcommand("reduce", "Write the reduced model of a design (HDF5)");
  add_study(*reduce, a.reduce.study);
  add_set(*reduce, a);
  reduce->add_option("-o,--output", a.reduce.model, "The model file to write")->type_name("MODEL.h5")->required();
  reduce->callback([&a] {
    a.command = [&a](const Streams& s) {
      a.reduce.overrides = a.overrides();
      return run_reduce(a.reduce, s);
    };
  });

  CLI::App* check = app.add_subcommand("check", "Read and validate a study, computing nothing");
  check->footer("Every problem is told at once, one sentence each, with the line it stands on.");
  add_study(*check, a.check.study);
  add_set(*check, a);
  check->callback([&a] {
    a.command = [&a](const Streams& s) {
      a.check.overrides = a.overrides();
      return run_check(a.check, s);
    };
  });

  CLI::App* create = app.add_subcommand("new", "Write a commented study to start from");
  create->add_option("FILE", a.create.file, "The study file to write (TOML); must not exist")
      ->required()
      ->type_name("");
  create->callback([&a] { a.command = [&a](const Streams& s) { return run_new(a.create, s); }; });
}

void define_model_commands(CLI::App& app, Arguments& a) {
  constexpr const char* kInput = "A reduced model (HDF5, or TOML with Matrix Market files) or a study file (TOML)";
  CLI::App* response = app.add_subcommand("response", "Frequency response of a model or a study's design");
  response->footer(
      "The frequencies are gone through in the order given; --from may exceed --to. JSON: {\"frequency_hz\", "
      "\"status\",\n"
      "\"iterations\", \"outputs\":{NAME:{\"amplitude\", \"cosine\", \"sine\"}}, \"dissipated_energy_j\", "
      "\"error_force\",\n"
      "\"error_energy\", \"wear_rate_m_per_cycle\", \"residual\", \"penalty_ratio\", \"settings\"}; "
      "cosine[.][0] is the\n"
      "mean. At a frequency that did not converge all numbers but the frequency, iterations and residual are null.\n"
      "\"settings\" holds the harmonics and samples used and the pseudo-penalties; a penalty ratio other than 1 "
      "multiplies\n"
      "these where a solve needed it. --arclength adds \"arclength\", and each analysis an object of its name, with\n"
      "one entry per frequency in each list.");
  response->add_option("INPUT", a.response.input, kInput)->required()->type_name("");
  response->add_option("--from", a.response.from_hz, "First frequency")->type_name("HZ")->required();
  response->add_option("--to", a.response.to_hz, "Last frequency")->type_name("HZ")->required();
  response->add_option("--points", a.response.points, "Number of frequencies, evenly spaced")
      ->type_name("N")
      ->required();
  response->add_flag("--arclength", a.response.arclength,
                     "Follow the response from --from through its turning points until it leaves the interval; the "
                     "frequencies are then those of the points computed, at most 1/(N-1) of the interval apart");
  AnalysisChoice& choice = a.response.choice;
  response->add_flag("--error-bars", choice.error_bars,
                     "How far harmonics, samples and pseudo-penalty may have moved each result");
  response->add_flag("--penalty-sensitivity", choice.penalty_sensitivity,
                     "Each result for 0.5, 1, 2 and 10 times the pseudo-penalty, and its logarithmic slope");
  response->add_flag("--stability", choice.stability,
                     "Local stability of each periodic solution, with its multipliers; says where it has no meaning");
  response->add_flag("--traction-bounds", choice.traction_bounds,
                     "Least and largest result found over the admissible residual tractions of stuck nodes");
  add_set(*response, a);
  add_solver(*response, a);
  add_json(*response, a.response.json);
  response->callback([&a] {
    a.command = [&a](const Streams& s) {
      a.response.overrides = a.overrides();
      a.response.solver = a.solver;
      return run_response(a.response, s);
    };
  });

  CLI::App* backbone =
      app.add_subcommand("backbone", "Resonance and its amplitude over the excitation's level or the wear");
  backbone->footer(
      "Each resonance is found from the ones before, not by sampling response curves. JSON: {\"over\", \"output\",\n"
      "\"parameter\", \"status\", \"frequency_hz\", \"amplitude\", \"frequency_error\", \"dissipated_energy_j\",\n"
      "\"searched\", \"jacobians\", \"settings\"}; one entry per parameter in each list.");
  backbone->add_option("INPUT", a.backbone.input, kInput)->required()->type_name("");
  backbone
      ->add_option("--over", a.backbone.over,
                   "force: the parameter multiplies the harmonics of the force, not its static part; wear: it is the "
                   "largest depth, m, of wear in proportion to the rates of the unworn resonance (default: force)")
      ->type_name("WHAT")
      ->check(CLI::IsMember({"force", "wear"}));
  backbone->add_option("--from", a.backbone.from, "First value of the parameter")->type_name("X")->required();
  backbone->add_option("--to", a.backbone.to, "Last value of the parameter")->type_name("X")->required();
  backbone->add_option("--points", a.backbone.points, "Number of values")->type_name("N")->required();
  backbone->add_flag("--logarithmic", a.backbone.logarithmic, "Space the values evenly on a logarithmic scale");
  backbone->add_option("--output", a.backbone.output, "Name of the output that resonates (default: the first)")
      ->type_name("NAME");
  backbone
      ->add_option("--frequency", a.backbone.frequency_hz,
                   "Where the first resonance is searched (default: the natural frequency of the study's mode, of a "
                   "model's lowest)")
      ->type_name("HZ");
  add_set(*backbone, a);
  add_solver(*backbone, a);
  add_json(*backbone, a.backbone.json);
  backbone->callback([&a] {
    a.command = [&a](const Streams& s) {
      a.backbone.overrides = a.overrides();
      a.backbone.solver = a.solver;
      return run_backbone(a.backbone, s);
    };
  });

  CLI::App* wear = app.add_subcommand("wear", "Worn state of a model or a study's design");
  wear->footer(
      "`asymptote` computes the shape at which wear comes to rest directly, `history` goes there cycle by cycle. With\n"
      "`--follow resonance` the excitation tracks the moving resonance (the asymptote: held until wear rests, then\n"
      "retuned, until the resonance stays); the worn volume may differ by tens of per cent. JSON: {\"method\", "
      "\"status\",\n"
      "\"follow\", \"frequency_hz\", \"frequencies_hz\", \"cycles\", \"worn_volume_m3\", \"depth_m\",\n"
      "\"final_wear_rate_m_per_cycle\", \"solves\", \"settings\"[, \"error_bars\"]}. A history that reached --cycles "
      "while still wearing has the "
      "status\n"
      "no_asymptote, one that used up --steps not_converged.");
  wear->add_option("INPUT", a.wear.input, kInput)->required()->type_name("");
  wear->add_option("--method", a.wear.method, "history or asymptote")
      ->required()
      ->type_name("METHOD")
      ->check(CLI::IsMember({"history", "asymptote"}));
  wear->add_option("--frequency", a.wear.frequency_hz,
                   "Excitation frequency (default: the unworn resonance of the study's mode, of a model's lowest)")
      ->type_name("HZ");
  wear->add_option("--follow", a.wear.follow,
                   "fixed: the frequency stays; resonance: it tracks the moving resonance (default: fixed)")
      ->type_name("WHAT")
      ->check(CLI::IsMember({"fixed", "resonance"}));
  wear->add_option("--cycles", a.wear.cycles, "history: end after so many cycles")->type_name("N");
  wear->add_option("--steps", a.wear.steps, "history: steps at most (default: 200)")->type_name("N");
  wear->add_option("--increment", a.wear.increment_m, "history: largest increase of depth per step, m (default: 1e-7)")
      ->type_name("M");
  wear->add_flag(
      "--error-bars", a.wear.error_bars,
      "How far harmonics, samples and pseudo-penalty may have moved volume and depth: four computations more");
  add_set(*wear, a);
  add_solver(*wear, a);
  add_json(*wear, a.wear.json);
  wear->callback([&a] {
    a.command = [&a](const Streams& s) {
      a.wear.overrides = a.overrides();
      a.wear.solver = a.solver;
      return run_wear(a.wear, s);
    };
  });
}

void define_file_commands(CLI::App& app, Arguments& a) {
  CLI::App* import =
      app.add_subcommand("import", "Write a reduced model given as Matrix Market files and TOML as HDF5");
  import->footer(
      "MODEL.toml says format = \"dovetail-reduced-model\", version = 1, names the files `mass`, `damping` and\n"
      "`stiffness`, and has a section [contact] (normal, tangential, area, gap, friction, wear_coefficient, one entry\n"
      "per node), sections [[force]] (dof, harmonic, cosine, sine) and [[output]] (name, dofs, factors); dofs count\n"
      "from 0. `response` and `wear` read it directly, too.");
  import->add_option("INPUT", a.import.input, "The model (TOML)")->required()->type_name("");
  import->add_option("-o,--output", a.import.model, "The model file to write")->type_name("MODEL.h5")->required();
  import->callback([&a] { a.command = [&a](const Streams& s) { return run_import(a.import, s);
};
}  // namespace
);

CLI::App* geometry = app.add_subcommand(
    "export", "Write geometry or fields of a finished run's best design or of a study, or matrices of a model");
std::string formats;
for (const std::string_view format : export_formats()) formats += std::string(format) + ", ";
geometry->footer(
    "matrix-market writes a reduced model (of a model file, a study or a run's best design) as FILE.toml and, beside\n"
    "it, FILE.mass.mtx, FILE.damping.mtx and FILE.stiffness.mtx; `import` turns them into HDF5 again, bit by bit.");
geometry->add_option("INPUT", a.geometry.input, "Directory of a run, a study file, or a reduced model")
    ->required()
    ->type_name("");
geometry->add_option("--format", a.geometry.format, "One of " + formats + std::string(kMatrixMarket))
    ->type_name("NAME")
    ->required();
geometry->add_option("-o,--output", a.geometry.file, "The file to write")->type_name("FILE")->required();
add_set(*geometry, a);
geometry->callback([&a] {
  a.command = [&a](const Streams& s) {
    a.geometry.overrides = a.overrides();
    return run_export(a.geometry, s);
  };
});

CLI::App* report = app.add_subcommand("report", "Write the report of a run again, from its stored results");
report->add_option("DIR", a.report.directory, "Directory of the run")->required()->type_name("");
report->add_option("-o,--output", a.report.file, "The page to write")->type_name("FILE.html")->required();
report->callback([&a] { a.command = [&a](const Streams& s) { return run_report(a.report, s); }; });
}  // namespace dovetail::studies

}  // namespace

std::vector<Override> Arguments::overrides() const {
  std::vector<Override> result;
  std::vector<Violation> found;
  for (const std::string& assignment : set) try {
      result.push_back(parse_override(assignment));
    } catch (const InputError& error) {
      found.insert(found.end(), error.violations().begin(), error.violations().end());
    }
  if (!found.empty()) throw InputError(std::move(found));
  return result;
}

void define_commands(CLI::App& app, Arguments& arguments) {
  define_study_commands(app, arguments);
  define_model_commands(app, arguments);
  define_file_commands(app, arguments);
}

}  // namespace dovetail::studies
