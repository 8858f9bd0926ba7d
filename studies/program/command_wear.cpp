#include <fmt/format.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <optional>
#include <ostream>
#include <utility>

#include "paths/resonance.hpp"
#include "paths/steady_state.hpp"
#include "quality/truncation.hpp"
#include "studies/program/commands.hpp"
#include "studies/program/engine.hpp"
#include "studies/program/interrupt.hpp"
#include "studies/program/json.hpp"
#include "studies/program/progress.hpp"
#include "studies/program/truncation_choice.hpp"
#include "studies/program/wear_methods.hpp"
#include "wear/spread.hpp"

namespace dovetail::studies {
namespace {

void validate(const WearOptions& options) {
  std::vector<Violation> found;
  const auto bad = [&](const char* option, const std::string& value, const std::string& allowed) {
    found.push_back({.file = {}, .key = option, .value = value, .allowed = allowed});
  };
  if (options.frequency_hz && !kFrequencies.contains(*options.frequency_hz))
    bad("--frequency", shortest(*options.frequency_hz), kFrequencies.phrase());
  if (options.cycles && !kPositive.contains(*options.cycles))
    bad("--cycles", shortest(*options.cycles), kPositive.phrase());
  if (options.increment_m && !kPositive.contains(*options.increment_m))
    bad("--increment", shortest(*options.increment_m), kPositive.phrase());
  if (options.steps && *options.steps < 1) bad("--steps", std::to_string(*options.steps), "must be >= 1");
  const bool band = options.follow == "band";
  for (const auto& [option, hz] :
       {std::pair{"--band-from", options.band_from_hz}, std::pair{"--band-to", options.band_to_hz}}) {
    if (hz && !kFrequencies.contains(*hz)) bad(option, shortest(*hz), kFrequencies.phrase());
    if (!band && hz) bad(option, "", "only has a meaning with --follow band");
    if (band && !hz) bad(option, "", "is needed with --follow band");
  }
  if (options.band_points < 1) bad("--band-points", std::to_string(options.band_points), "must be >= 1");
  if (band && options.frequency_hz) bad("--frequency", "", "has no meaning with --follow band");
  if (options.history_tolerance && !(*options.history_tolerance >= 0 && *options.history_tolerance <= 0.5))
    bad("--history-tolerance", shortest(*options.history_tolerance), "must be >= 0 and <= 0.5");
  if (options.method != "history") {
    if (options.cycles || options.steps || options.increment_m || options.history_tolerance)
      bad("--cycles, --steps, --increment, --history-tolerance", "", "only have a meaning with --method history");
    if (options.integrator == "implicit" || !options.resume.empty() || options.curves > 0)
      bad("--integrator, --resume, --curves", "", "only have a meaning with --method history");
  }
  if (options.integrator == "implicit") {
    if (options.history_tolerance == 0.0) bad("--history-tolerance", "0", "must be > 0 with --integrator implicit");
    if (options.follow == "resonance") bad("--follow", options.follow, "needs --integrator explicit");
    if (options.increment_m)
      bad("--increment", "", "has no meaning with --integrator implicit: see --history-tolerance");
  }
  if (!options.resume.empty() && (band || options.error_bars || options.spread))
    bad("--resume", options.resume, "goes on with one history: no --follow band, --error-bars or --spread");
  if (options.curves < 0 || options.curve_points < 1) bad("--curves, --curve-points", "", "must be >= 0 and >= 1");
  if (options.curve_from_hz.has_value() != options.curve_to_hz.has_value())
    bad("--curve-from, --curve-to", "", "need each other");
  for (const auto& [option, hz] :
       {std::pair{"--curve-from", options.curve_from_hz}, std::pair{"--curve-to", options.curve_to_hz}})
    if (hz && !kFrequencies.contains(*hz)) bad(option, shortest(*hz), kFrequencies.phrase());
  if (!found.empty()) throw InputError(std::move(found));
}

/// What is left of a worn state for its error bars; NaN where wear did not come to an end.
struct WornState {
  double volume = std::nan(""), depth = std::nan("");
};

WornState worn_state(const WearAnswer& answer) {
  return answer.worn_out() ? WornState{.volume = answer.volume, .depth = answer.largest_depth()} : WornState{};
}

/// Error bars of a worn state: it is computed again from the start at the settings of quality::error_bars.
WearBars worn_bars(const LoadedModel& loaded, const WornState& nominal,
                   const std::function<WornState(const LoadedModel&)>& compute) {
  const auto changed = [&](steady::Options settings) {
    LoadedModel again = loaded;
    again.joint.options = std::move(settings);
    return compute(again);
  };
  const auto scaled = [&](double ratio) {
    steady::Options settings = loaded.joint.options;
    settings.penalty_scale *= ratio;
    return changed(settings);
  };
  const WornState harmonics = changed(quality::more_harmonics(loaded.joint.options));
  const WornState samples = changed(quality::more_samples(loaded.joint.options));
  const WornState softer = scaled(0.5), stiffer = scaled(2);
  const auto bar = [&](double WornState::*value) {
    const auto change = [&](const WornState& other) {
      const double difference = std::abs(other.*value - nominal.*value);
      return std::isnan(difference) ? kInfinity : difference;  // not computed: unknown
    };
    return quality::bar_from({.harmonics = change(harmonics),
                              .samples = change(samples),
                              .softer = change(softer),
                              .stiffer = change(stiffer)},
                             loaded.joint.model->massless_contact());
  };
  return {.worn_volume = bar(&WornState::volume), .largest_depth = bar(&WornState::depth)};
}

/// What the spread and the bars see of an answer.
wear::WornEnd worn_end(const WearAnswer& answer) {
  wear::WornEnd end{.status = answer.solver, .volume = answer.volume, .depth = answer.depth, .solves = answer.solves};
  end.verdict = answer.worn_out()                 ? wear::Verdict::asymptote
                : answer.status == "no_asymptote" ? wear::Verdict::no_asymptote
                                                  : wear::Verdict::not_converged;
  return end;
}

/// Every member is computed as the answer was: at the frequency given, or at its own resonance.
wear::Spread spread_of(const WearOptions& options, const LoadedModel& loaded, const WearStart& at,
                       const WearAnswer& answer, const wear::Control& control) {
  std::optional<steady::State> unworn;
  if (at.resonance)
    unworn = at.resonance->state;
  else
    unworn = paths::steady_state(loaded.joint, at.omega);
  const auto compute = [&](const steady::Joint& joint) {
    wear::WornEnd failed;
    failed.status = Status::interrupted;
    if (control.stopped()) return failed;
    LoadedModel changed = loaded;
    changed.joint = joint;
    WearStart from = at;
    if (at.resonance) {
      from.resonance = paths::resonance(joint, at.omega, {}, at.resonance->state.displacement);
      if (!from.found()) {
        failed.status = from.resonance->status;
        failed.solves = from.resonance->solves;
        return failed;
      }
      from.omega = from.resonance->omega;
      from.hz = from.omega / (2 * std::numbers::pi);
    }
    return worn_end(wear_answer(options, changed, from, control));
  };
  const bool solved = unworn->status == Status::converged;
  return wear::spread(loaded.joint, worn_end(answer), compute, solved ? &*unworn : nullptr);
}

std::string follow_words(const std::string& follow) {
  if (follow == "band") return "the worst of the band";
  return follow == "resonance" ? "at first; following the resonance" : "held";
}

/// The wear that goes on at the worn state, as a share of the unworn rate.
std::string certificate_words(const wear::Asymptote& asymptote) {
  std::string text = fmt::format("remaining_rate  {:.2g} of the unworn one", asymptote.certificate);
  const wear::Certificate& finer = asymptote.finer;
  if (finer.harmonics > 0) {
    text += finer.status == Status::converged ? fmt::format("; {:.2g}", finer.remaining)
                                              : "; not known (" + std::string(to_string(finer.status)) + ")";
    text += fmt::format(" at {} harmonics, {} samples{}", finer.harmonics, finer.samples,
                        asymptote.holds_finer ? "" : ": raise --harmonics and --samples");
  }
  text += "\n";
  if (asymptote.doubt == wear::Doubt::none) return text;
  text += fmt::format("doubt           {}: {}", to_string(asymptote.doubt), entry(asymptote.doubt).meaning);
  if (asymptote.confirmed_by_history && asymptote.holds_finer) text += ", settled by the history at these settings";
  for (const wear::OtherState& other : asymptote.other_states)
    if (other.found_by == wear::FoundBy::release)
      text += fmt::format("; the direct method ends with {:.6g} m^3", other.worn_volume);
  return text + "\n";
}

std::string summary(const WearQuestion& question, const WearAnswer& answer) {
  const char* unknown = answer.status == "no_asymptote" ? "none: wear goes on for ever" : "not known";
  const auto known = [&](double value, double WearBars::*bar) {
    if (!answer.known()) return std::string(unknown);
    std::string text = fmt::format("{:.6g}", value);
    if (!question.bars) return text;
    const double size = *question.bars.*bar;
    return text + (std::isfinite(size) ? fmt::format(" +- {:.2g}", size) : " +- not known");
  };
  const std::string status = answer.status + (answer.reason.empty() ? "" : " (" + answer.reason + ")");
  std::string text =
      fmt::format("status          {}\nfrequency_hz    {:.9g} ({})\nworn_volume_m3  {}\n", status,
                  question.frequency_hz, follow_words(question.follow), known(answer.volume, &WearBars::worn_volume));
  text += fmt::format("largest_depth_m {}\nsolves          {}\n",
                      known(answer.largest_depth(), &WearBars::largest_depth), answer.solves);
  if (answer.asymptote && answer.worn_out()) text += certificate_words(*answer.asymptote);
  if (!question.spread) return text;
  for (const wear::SpreadRange& range : question.spread->ranges)
    text += fmt::format("spread {:<18} volume {:.4g} to {:.4g} m^3, depth {:.4g} to {:.4g} m ({}{})\n", range.source,
                        range.lowest_volume, range.highest_volume, range.lowest_depth, range.highest_depth,
                        wear::to_string(range.verdict),
                        range.failed > 0 ? fmt::format(", {} of {} failed", range.failed, range.members) : "");
  return text;
}

int verdict(const std::string& input, const WearAnswer& answer, bool interrupted, const Streams& streams) {
  if (interrupted) return kInterrupted;
  // Who asked for a number of cycles has them.
  const bool has_cycles = answer.history && answer.history->end == wear::HistoryEnd::cycles;
  if (answer.status != "not_converged" || has_cycles) return kDone;
  const bool out_of_steps = answer.history && answer.history->end == wear::HistoryEnd::steps;
  streams.err << fmt::format("dovetail: {}: the worn state did not converge: {}{}\n", input, to_string(answer.solver),
                             !out_of_steps ? ""
                             : answer.choice.options.integrator == "implicit"
                                 ? ": allow more --steps"
                                 : ": allow more --steps, or a larger --increment of depth");
  return kNotConverged;
}

/// The choices of the command line, or else of the study and what its law asks for: under a threshold nodes come to
/// rest in slip, and increments of depth end well beyond that.
WearOptions with_choices(WearOptions options, const LoadedModel& loaded) {
  if (options.follow.empty()) options.follow = loaded.follow;
  if (!options.integrator.empty()) return options;
  const Eigen::VectorXd& threshold = loaded.model.contact.wear_threshold;
  const bool rests_in_slip = threshold.size() > 0 && threshold.maxCoeff() > 0;
  options.integrator = rests_in_slip && options.follow != "resonance" && !options.increment_m ? "implicit" : "explicit";
  return options;
}

/// What only the study and the model together can contradict.
void check_follow(const WearOptions& options, const LoadedModel& loaded) {
  if (options.follow != "resonance") return;
  const auto refuse = [&](const std::string& allowed) {
    throw InputError(Violation{.file = {}, .key = "--follow", .value = options.follow, .allowed = allowed});
  };
  if (options.integrator == "implicit") refuse("needs --integrator explicit");
  if (loaded.model.mass.isZero(0.0)) refuse("needs a model with mass: a quasi-static one has no resonance");
}

}  // namespace

int run_wear(const WearOptions& given, const Streams& streams) {
  validate(given);
  check_accuracy(given.solver);
  LoadedModel loaded = load_model(given.input, given.overrides, given.solver);
  const WearOptions options = with_choices(given, loaded);
  const auto failed = [&](const std::string& why) {
    streams.err << "dovetail: " << options.input << ": " << why << "\n";
    return static_cast<int>(kNotConverged);
  };
  // A computation that ends before it has a state leaves an answer, too.
  const auto without_state = [&](Status status, const std::string& why, int solves) {
    WearAnswer answer = unknown_answer(options, loaded.model.contact.count(), status);
    answer.reason = why;
    answer.solves = solves;
    const WearQuestion question{
        .frequency_hz = std::nan(""), .follow = options.follow, .settings = loaded.joint.options};
    if (!options.json.empty()) deliver_json(options.json, wear_json(question, answer), streams);
    return failed("not converged: " + why);
  };
  if (!loaded.failure.empty()) return without_state(Status::iteration_limit, loaded.failure, 0);
  if (loaded.model.contact.count() == 0)
    throw InputError(
        Violation{.file = {}, .key = options.input, .value = {}, .allowed = "has no contact nodes: nothing can wear"});
  check_follow(options, loaded);
  const bool over_band = options.follow == "band";
  const auto begin = [&](const LoadedModel& model) {
    return over_band ? wear_start_at((*options.band_from_hz + *options.band_to_hz) / 2) : wear_start(options, model);
  };
  WearStart at = begin(loaded);
  std::optional<Status> automatic;
  if (at.found() && options.solver.automatic()) {
    automatic = choose_truncation(loaded, {at.hz}, options.solver);
    at = begin(loaded);
  }
  if (!at.found())
    return without_state(at.resonance->status,
                         "unworn resonance: " + std::string(to_string(at.resonance->status)) + "; give --frequency HZ",
                         at.resonance->solves);

  const OrderlyInterrupt interrupt;
  wear::Control control;
  control.stop = [&] { return interrupt.requested(); };
  const bool terminal = error_is_terminal();
  if (terminal)
    control.progress = [&](int step, double volume, double rate) {
      streams.err << fmt::format("\r\033[Kstep {}, worn volume {:.4g} m^3, largest rate {:.3g} m per cycle", step,
                                 volume, rate)
                  << std::flush;
    };
  WearQuestion question{.frequency_hz = at.hz, .follow = options.follow, .settings = loaded.joint.options};
  std::optional<WearBand> band;
  WearAnswer answer;
  if (over_band) {
    band = wear_band(options, loaded, control);
    answer = band->answer;
    question.band = &*band;
    if (!band->frequencies_hz.empty()) question.frequency_hz = band->frequencies_hz[band->worst];
    at = wear_start_at(question.frequency_hz);
  } else {
    answer = wear_answer(options, loaded, at, control);
  }
  const auto again = [&](const LoadedModel& model) {
    if (interrupt.requested()) return WornState{};
    const WearStart from = over_band ? at : wear_start(options, model);
    if (!from.found()) return WornState{};
    return worn_state(wear_answer(options, model, from, control));
  };
  if (answer.history && options.curves > 0) answer.curves = worn_curves(options, loaded, *answer.history, control);
  if (automatic) question.automatic = WearQuestion::Automatic{*automatic, accuracy(options.solver)};
  if (options.error_bars) question.bars = worn_bars(loaded, worn_state(answer), again);
  if (options.spread) question.spread = spread_of(options, loaded, at, answer, control);
  if (terminal) streams.err << "\r\033[K" << std::flush;
  if (!options.json.empty()) deliver_json(options.json, wear_json(question, answer), streams);
  if (options.json.empty()) streams.out << summary(question, answer);
  const int end = verdict(options.input, answer, interrupt.requested(), streams);
  if (end == kDone && automatic && *automatic != Status::converged)
    return failed(truncation_complaint(*automatic, loaded.joint.options, options.solver));
  if (end == kDone && question.spread && !question.spread->ranges.empty() && question.spread->ranges.back().failed > 0)
    return failed(fmt::format("{} of {} members of the spread did not converge", question.spread->ranges.back().failed,
                              question.spread->ranges.back().members));
  return end;
}

}  // namespace dovetail::studies
