#include "studies/program/commands/help.hpp"

#include "optimizer/journal/evaluation_json.hpp"

namespace dovetail::studies::help {

CommandHelp run() {
  return {
      .name = "run",
      .what = "Optimise a study",
      .footer =
          "The directory gets journal.jsonl (every evaluation, appended as it finishes), best.toml (a study file that\n"
          "evaluates to the best design), results.h5, report.html and the exports the study asks for. Ctrl-C ends the "
          "run\n"
          "in order; `--resume` continues it: stored evaluations are not computed again."};
}

CommandHelp evaluate() {
  return {.name = "evaluate",
          .what = "Compute one design: all responses with error estimates",
          .footer = "JSON: {" + optimizer::listed_keys<optimizer::Evaluation>() +
                    "}; derivatives where they are known,\n"
                    "parameters in the study file's units, all else SI; constraints hold when <= 0. With [solver] "
                    "accuracy in the\n"
                    "study, or --harmonics auto, --samples auto, also \"accuracy\": {\"status\", \"settings\", "
                    "\"response\", \"source\",\n"
                    "\"relative_bar\", \"relative_bar_total\", \"asked\", \"not_held\", \"raised\", \"rounds\", "
                    "\"work\", \"one_more_digit\"[, \"reached\", \"whole_bar\"]}:\n"
                    "what was chosen, and the response whose bar is largest over what was asked; exit status 3 where "
                    "that is not\n"
                    "reached with all parts of the bars. not_held: responses asked for whose value is zero or missing, "
                    "or has no bar.\n"
                    "one_more_digit: null where no settings there are should leave a tenth."};
}

CommandHelp reduce() {
  return {.name = "reduce", .what = "Write the reduced model of a design (HDF5)"};
}

CommandHelp check() {
  return {.name = "check",
          .what = "Read and validate a study, computing nothing",
          .footer =
              "Every problem is told at once, one sentence each, with the line it stands on. --set is taken as `run` "
              "takes it.\n"
              "Sectors too large for solver.prestress = \"shared\" assemble the stress of their own preload."};
}

CommandHelp create() {
  return {.name = "new", .what = "Write a commented study to start from"};
}

CommandHelp materials() {
  return {
      .name = "materials",
      .what = "List the materials that a study may name",
      .footer =
          "A study names one as  material = \"Inconel 718\"  for blade and disk, or as grade in [material.blade] and\n"
          "[material.disk], where numbers replace single values of it. JSON: {\"version\", \"materials\":\n"
          "[{\"name\", \"youngs_modulus_gpa\", \"poisson_ratio\", \"density_kg_m3\", \"source\"}]}."};
}

CommandHelp response() {
  return {
      .name = "response",
      .what = "Frequency response of a model or a study's design",
      .footer =
          "The frequencies are gone through in the order given; --from may exceed --to. JSON: {\"frequency_hz\", "
          "\"status\",\n"
          "\"iterations\", \"outputs\":{NAME:{\"amplitude\", \"cosine\", \"sine\"}}, \"dissipated_energy_j\", "
          "\"error_force\",\n"
          "\"error_energy\", \"wear_rate_m_per_cycle\", \"residual\", \"penalty_ratio\", \"settings\"}; "
          "cosine[.][0] is the\n"
          "mean. At a frequency that did not converge all numbers but the frequency, iterations and residual are "
          "null.\n"
          "\"settings\" holds the harmonics and samples used and the pseudo-penalties; a penalty ratio other than 1 "
          "multiplies\n"
          "these where a solve needed it. --arclength adds \"arclength\", and each analysis an object of its name, "
          "with\n"
          "one entry per frequency in each list."};
}

CommandHelp backbone() {
  return {
      .name = "backbone",
      .what = "Resonance and its amplitude over the excitation's level or the wear",
      .footer =
          "Each resonance is found from the ones before, not by sampling response curves; --harmonics and --samples\n"
          "are numbers here. JSON: {\"over\", \"output\", \"parameter\", \"status\", \"frequency_hz\", \"amplitude\",\n"
          "\"frequency_error\", \"dissipated_energy_j\", \"searched\", \"jumped\", \"checked\", \"jacobians\", "
          "\"settings\"};\n"
          "one entry per parameter in each list. \"jumped\": not the peak of the level before; \"checked\": no point\n"
          "within 40 % of its frequency is higher by more than 1 / samples."};
}

CommandHelp wear() {
  return {
      .name = "wear",
      .what = "Worn state of a model or a study's design",
      .footer =
          "`asymptote` computes the shape at which wear comes to rest directly, `history` goes there cycle by cycle. "
          "What\n"
          "drives the wear is --follow: a frequency that is held; the resonance, tracked as the joint wears "
          "(asymptote: "
          "held\n"
          "until wear rests, then retuned, until the resonance stays; the worn volume may differ by tens of per cent); "
          "or "
          "a\n"
          "band of held frequencies, of which the answer is the one with the largest worn volume. JSON: {\"method\",\n"
          "\"status\", \"follow\", \"frequency_hz\", \"frequencies_hz\", \"cycles\", \"worn_volume_m3\", \"depth_m\",\n"
          "\"final_wear_rate_m_per_cycle\", \"solves\", \"settings\"[, \"error_bars\", \"spread\", \"band\"]}; an "
          "asymptote adds\n"
          "\"certificate\" "
          "(largest\nremaining wear rate over the unworn one), \"finer_certificate\" (at 2H+1 harmonics and 2N "
          "samples) "
          "and\n\"other_states\"; a history \"depths_m\" and \"wear_rates_m_per_cycle\" of every state, \"history\" "
          "(its options)\nand \"response_curves\".\n"
          "\"spread\" holds, per source, \"status\", \"nominal\", \"low\", \"high\", \"profile_change\" and every "
          "member. "
          "A history "
          "that\n"
          "reached --cycles while still wearing has the status not_converged, too, its \"reason\" says so, and the "
          "exit "
          "status is 0."};
}

CommandHelp import_model() {
  return {
      .name = "import",
      .what = "Write a reduced model given as Matrix Market files and TOML as HDF5",
      .footer =
          "MODEL.toml says format = \"dovetail-reduced-model\", version = 1, names the files `mass`, `damping` and\n"
          "`stiffness`, and has a section [contact] (normal, tangential, area, gap, friction, wear_coefficient, one "
          "entry\n"
          "per node), sections [[force]] (dof, harmonic, cosine, sine) and [[output]] (name, dofs, factors); dofs "
          "count\n"
          "from 0. `response` and `wear` read it directly, too. With format = \"dovetail-structure\" `stiffness` and "
          "`mass` "
          "are\n"
          "matrices as CalculiX, Abaqus and others write them, with pairs of nodes in contact: they are reduced."};
}

CommandHelp export_files() {
  return {
      .name = "export",
      .what = "Write geometry, finite elements or fields of a run's best design or of a study, or matrices of a model",
      .footer =
          "step, iges and stl write blade and disk of one sector as solids, or their surfaces in triangles (binary); "
          "mm.\n"
          "vtu writes stress, contact pressure, slip, wear depth and mode shapes on the mesh, pvd a series of files "
          "over "
          "the\n"
          "wear history, csv a table of all candidates of a run.\n"
          "inp writes the sector's finite elements for CalculiX (units mm, tonne, s): centrifugal load at the study's "
          "speed,\n"
          "then natural frequencies; --nodal-diameter, --modes and --contact choose what is asked for.\n"
          "matrix-market writes a reduced model (of a model file, a study or a run's best design) as FILE.toml and, "
          "beside\n"
          "it, FILE.mass.mtx, FILE.damping.mtx and FILE.stiffness.mtx; `import` turns them into HDF5 again, bit by "
          "bit."};
}

CommandHelp runs() {
  return {.name = "runs",
          .what = "List and compare runs: status, evaluations, objective and best values",
          .footer =
              "A run that has no results yet counts as far as its journal goes. JSON: {\"version\", \"runs\": "
              "[{\"directory\",\n\"name\", \"status\", \"evaluations\", \"feasible\", \"failed\", \"best\", "
              "\"objective\", \"start\", "
              "\"variables\", \"responses\", \"seconds\"}]};\nvariables and responses are those of the best design, "
              "null what is not known."};
}

CommandHelp serve() {
  return {.name = "serve",
          .what = "Serve a study as a model over HTTP (UM-Bridge protocol 1.0)",
          .footer =
              "POST /Evaluate takes the design variables in their order and the units of the file, and gives the "
              "responses\n"
              "that objective and limits name, SI; /ModelInfo names both."};
}

CommandHelp schema() {
  return {.name = "schema", .what = "Write the JSON Schema of study files, or of the JSON of a command"};
}

CommandHelp completion() {
  return {.name = "completion",
          .what = "Write what completes the command line in bash or zsh, or the manual page",
          .footer =
              "bash: source <(dovetail completion bash)   zsh: dovetail completion zsh > a folder of $fpath/_dovetail\n"
              "`cmake --install` puts all three where they belong."};
}

CommandHelp merge() {
  return {.name = "merge",
          .what = "Put the evaluations of several runs of one study together",
          .footer = "`dovetail run STUDY.toml -o DIR --resume` then goes on with all of them."};
}

CommandHelp report() {
  return {.name = "report", .what = "Write the report of a run again, from its stored results"};
}

}  // namespace dovetail::studies::help
