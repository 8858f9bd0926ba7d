#include "studies/program/commands/shared_arguments.hpp"

namespace dovetail::studies {
namespace {

constexpr const char* kInput = "A reduced model (HDF5, or TOML with Matrix Market files) or a study file (TOML)";

void define_response(CLI::App& app, Arguments& a) {
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
  runs(*response, a, a.response, run_response);
}

void define_backbone(CLI::App& app, Arguments& a) {
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
  runs(*backbone, a, a.backbone, run_backbone);
}

/// Options of a history.
void add_history(CLI::App* wear, WearOptions& o) {
  wear->add_option("--cycles", o.cycles, "history: end after so many cycles")->type_name("N");
  wear->add_option("--steps", o.steps, "history: steps at most (default: 1000)")->type_name("N");
  wear->add_option("--increment", o.increment_m,
                   "explicit history: largest increase of depth per step, m (default: a hundredth of the largest depth "
                   "of the directly computed worn state, or of the elastic penetration where there is none)")
      ->type_name("M");
  wear->add_option("--integrator", o.integrator,
                   "history: explicit, by increments of depth; or implicit, in large steps of controlled error "
                   "(default: explicit; under an energy threshold implicit)")
      ->type_name("WHICH")
      ->check(CLI::IsMember({"explicit", "implicit"}));
  wear->add_option("--history-tolerance", o.history_tolerance,
                   "history: local error per step relative to the depth (default: explicit 0, increments as they are; "
                   "implicit 2e-4)")
      ->type_name("X");
  wear->add_option(
          "--resume", o.resume,
          "history: go on from the last state in this file, which --json of another history of the same "
          "model at the same settings has written; the answer begins with the states in it, and --steps counts "
          "the new ones")
      ->type_name("FILE");
  wear->add_option("--curves", o.curves,
                   "history: response curves of so many of its states, evenly spaced in worn volume (default: 0)")
      ->type_name("N");
  wear->add_option("--curve-points", o.curve_points, "Frequencies of each curve (default: 60)")->type_name("M");
  wear->add_option("--curve-from", o.curve_from_hz, "First frequency of the curves (default: around the peaks)")
      ->type_name("HZ");
  wear->add_option("--curve-to", o.curve_to_hz, "Last frequency of the curves")->type_name("HZ");
}

void define_wear(CLI::App& app, Arguments& a) {
  CLI::App* wear = app.add_subcommand("wear", "Worn state of a model or a study's design");
  wear->footer(
      "`asymptote` computes the shape at which wear comes to rest directly, `history` goes there cycle by cycle. What\n"
      "drives the wear is --follow: a frequency that is held; the resonance, tracked as the joint wears (asymptote: "
      "held\n"
      "until wear rests, then retuned, until the resonance stays; the worn volume may differ by tens of per cent); or "
      "a\n"
      "band of held frequencies, of which the answer is the one with the largest worn volume. JSON: {\"method\",\n"
      "\"status\", \"follow\", \"frequency_hz\", \"frequencies_hz\", \"cycles\", \"worn_volume_m3\", \"depth_m\",\n"
      "\"final_wear_rate_m_per_cycle\", \"solves\", \"settings\"[, \"error_bars\", \"spread\", \"band\"]}; an "
      "asymptote adds\n"
      "\"certificate\" "
      "(largest\nremaining wear rate over the unworn one), \"finer_certificate\" (at 2H+1 harmonics and 2N samples) "
      "and\n\"other_states\"; a history \"depths_m\" and \"wear_rates_m_per_cycle\" of every state, \"history\" "
      "(its options)\nand \"response_curves\".\n"
      "\"spread\" holds, per source, \"status\", \"nominal\", \"low\", \"high\", \"profile_change\" and every member. "
      "A history "
      "that\n"
      "reached --cycles while still wearing has the status not_converged, too, its \"reason\" says so, and the exit "
      "status is 0.");
  wear->add_option("INPUT", a.wear.input, kInput)->required()->type_name("");
  wear->add_option("--method", a.wear.method, "history or asymptote")
      ->required()
      ->type_name("METHOD")
      ->check(CLI::IsMember({"history", "asymptote"}));
  wear->add_option("--frequency", a.wear.frequency_hz,
                   "Excitation frequency (default: the unworn resonance of the study's mode, of a model's lowest)")
      ->type_name("HZ");
  wear->add_option("--follow", a.wear.follow,
                   "fixed: the frequency stays; resonance: it tracks the moving resonance (not with --integrator "
                   "implicit); band: the worst of several "
                   "held ones (default: loading.follow of a study, fixed for a model)")
      ->type_name("WHAT")
      ->check(CLI::IsMember({"fixed", "resonance", "band"}));
  wear->add_option("--band-from", a.wear.band_from_hz, "First frequency of the band")->type_name("HZ");
  wear->add_option("--band-to", a.wear.band_to_hz, "Last frequency of the band")->type_name("HZ");
  wear->add_option("--band-points", a.wear.band_points, "Frequencies of the band (default: 11)")->type_name("N");
  add_history(wear, a.wear);
  wear->add_flag(
      "--error-bars", a.wear.error_bars,
      "How far harmonics, samples and pseudo-penalty may have moved volume and depth: four computations more");
  wear->add_flag(
      "--spread", a.wear.spread,
      "How the worn state depends on what is not known: wear coefficient +-50 %, friction +-20 %, excitation "
      "+-10 %, residual tractions of stuck nodes, and all together: ten to fifteen computations more");
  add_set(*wear, a);
  add_solver(*wear, a);
  add_json(*wear, a.wear.json);
  runs(*wear, a, a.wear, run_wear);
}

}  // namespace

void define_model_commands(CLI::App& app, Arguments& arguments) {
  define_response(app, arguments);
  define_backbone(app, arguments);
  define_wear(app, arguments);
}

}  // namespace dovetail::studies
