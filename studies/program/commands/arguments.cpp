#include "studies/program/commands/arguments.hpp"

#include "optimizer/journal/evaluation_json.hpp"
#include "studies/program/commands/shared_arguments.hpp"
#include "studies/program/engine/engine.hpp"
#include "studies/program/study_file/export.hpp"
#include "studies/program/study_file/refusal.hpp"

namespace dovetail::studies {
namespace {

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
  runs(*run, a, a.run, [](const RunOptions& options, const Streams& s) { return run_study(options, s, study_engine); });

  CLI::App* evaluate = app.add_subcommand("evaluate", "Compute one design: all responses with error estimates");
  evaluate->footer("JSON: {" + optimizer::listed_keys<optimizer::Evaluation>() +
                   "}; derivatives where they are known,\n"
                   "parameters in the study file's units, all else SI; constraints hold when <= 0.");
  add_study(*evaluate, a.evaluate.study);
  add_set(*evaluate, a);
  add_solver(*evaluate, a);
  add_json(*evaluate, a.evaluate.json);
  evaluate->add_flag("--no-bars", a.evaluate.no_bars,
                     "Responses alone, without their error bars: in a fraction of the time");
  evaluate->add_flag("--no-history", a.evaluate.no_history,
                     "The direct worn state stands where it is in doubt, as in a search: the wear history is asked "
                     "only where the direct method finds none");
  evaluate->add_flag("--unworn", a.evaluate.unworn,
                     "Responses of the joint before it wears, and limits on them, without error bars");
  runs(*evaluate, a, a.evaluate, run_evaluate);

  CLI::App* reduce = app.add_subcommand("reduce", "Write the reduced model of a design (HDF5)");
  add_study(*reduce, a.reduce.study);
  add_set(*reduce, a);
  reduce->add_option("-o,--output", a.reduce.model, "The model file to write")->type_name("MODEL.h5")->required();
  runs(*reduce, a, a.reduce, run_reduce);

  CLI::App* check = app.add_subcommand("check", "Read and validate a study, computing nothing");
  check->footer("Every problem is told at once, one sentence each, with the line it stands on.");
  add_study(*check, a.check.study);
  add_set(*check, a);
  runs(*check, a, a.check, run_check);

  CLI::App* create = app.add_subcommand("new", "Write a commented study to start from");
  create->add_option("FILE", a.create.file, "The study file to write (TOML); must not exist")
      ->required()
      ->type_name("");
  runs(*create, a, a.create, run_new);
}

void define_file_commands(CLI::App& app, Arguments& a) {
  CLI::App* import_model =
      app.add_subcommand("import", "Write a reduced model given as Matrix Market files and TOML as HDF5");
  import_model->footer(
      "MODEL.toml says format = \"dovetail-reduced-model\", version = 1, names the files `mass`, `damping` and\n"
      "`stiffness`, and has a section [contact] (normal, tangential, area, gap, friction, wear_coefficient, one entry\n"
      "per node), sections [[force]] (dof, harmonic, cosine, sine) and [[output]] (name, dofs, factors); dofs count\n"
      "from 0. `response` and `wear` read it directly, too.");
  import_model->add_option("INPUT", a.import.input, "The model (TOML)")->required()->type_name("");
  import_model->add_option("-o,--output", a.import.model, "The model file to write")->type_name("MODEL.h5")->required();
  runs(*import_model, a, a.import, run_import);

  CLI::App* geometry = app.add_subcommand(
      "export",
      "Write geometry, finite elements or fields of a run's best design or of a study, or matrices of a model");
  std::string formats;
  for (const std::string_view format : export_formats()) formats += std::string(format) + ", ";
  geometry->footer(
      "stl writes the surfaces of blade and disk (binary, mm) of a study in space.\n"
      "inp writes the sector's finite elements for CalculiX (units mm, tonne, s): centrifugal load at the study's "
      "speed,\n"
      "then natural frequencies; --nodal-diameter, --modes and --contact choose what is asked for.\n"
      "matrix-market writes a reduced model (of a model file, a study or a run's best design) as FILE.toml and, "
      "beside\n"
      "it, FILE.mass.mtx, FILE.damping.mtx and FILE.stiffness.mtx; `import` turns them into HDF5 again, bit by bit.");
  geometry->add_option("INPUT", a.geometry.input, "Directory of a run, a study file, or a reduced model")
      ->required()
      ->type_name("");
  geometry->add_option("--format", a.geometry.format, "One of " + formats + std::string(kMatrixMarket))
      ->type_name("NAME")
      ->required();
  geometry->add_option("-o,--output", a.geometry.file, "The file to write")->type_name("FILE")->required();
  geometry
      ->add_option("--nodal-diameter", a.geometry.deck.nodal_diameters,
                   "inp: nodal diameters of the frequency steps, separated by commas (default: the study's)")
      ->delimiter(',')
      ->type_name("N");
  geometry->add_option("--modes", a.geometry.deck.modes, "inp: modes per nodal diameter")
      ->check(CLI::PositiveNumber)
      ->type_name("N");
  geometry->add_flag("--contact", a.geometry.deck.contact, "inp: flanks in frictional contact, not glued");
  add_set(*geometry, a);
  runs(*geometry, a, a.geometry, run_export);

  CLI::App* report = app.add_subcommand("report", "Write the report of a run again, from its stored results");
  report->add_option("DIR", a.report.directory, "Directory of the run")->required()->type_name("");
  report->add_option("-o,--output", a.report.file, "The page to write")->type_name("FILE.html")->required();
  runs(*report, a, a.report, run_report);
}

}  // namespace

std::vector<Override> Arguments::overrides() const {
  std::vector<Override> result;
  std::vector<Violation> found;
  for (const std::string& assignment : set) try {
      result.push_back(parse_override(assignment));
    } catch (const InputError& error) {
      found.insert(found.end(), error.violations().begin(), error.violations().end());
    }
  refuse(std::move(found));
  return result;
}

void define_commands(CLI::App& app, Arguments& arguments) {
  define_study_commands(app, arguments);
  define_model_commands(app, arguments);
  define_file_commands(app, arguments);
}

}  // namespace dovetail::studies
