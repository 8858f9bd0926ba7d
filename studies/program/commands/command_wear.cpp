#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>
#include <ostream>
#include <utility>

#include "studies/program/answers/json.hpp"
#include "studies/program/answers/teller.hpp"
#include "studies/program/commands/commands.hpp"
#include "studies/program/engine/interrupt.hpp"
#include "studies/program/engine/loaded_model.hpp"
#include "studies/program/engine/truncation_choice.hpp"
#include "studies/program/engine/wear_quality.hpp"
#include "studies/program/study_file/refusal.hpp"
#include "wear/measures.hpp"

namespace dovetail::studies {
namespace {

std::string_view follow_words(Drive follow) {
  switch (follow) {
    case Drive::fixed:
      return "held";
    case Drive::resonance:
      return "at first; following the resonance";
    case Drive::band:
      return "the worst of the band";
  }
  return "";
}

/// "; the history ends with 1.2 m^3", or "... with 1.2 to 1.3 m^3" when it did so more than once.
std::string ends_words(std::string_view name, wear::FoundBy way, const std::vector<wear::OtherState>& states) {
  std::vector<double> volumes;
  for (const wear::OtherState& other : states)
    if (other.found_by == way) volumes.push_back(other.worn_volume);
  if (volumes.empty()) return {};
  const auto [least, most] = std::ranges::minmax(volumes);
  const std::string from = fmt::format("{:.6g}", least), to = fmt::format("{:.6g}", most);
  return fmt::format("; {} ends with {}{} m^3", name, from, from == to ? "" : " to " + to);
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
  const auto by_history = [](const wear::OtherState& other) { return other.found_by == wear::FoundBy::history; };
  if (std::ranges::any_of(asymptote.other_states, by_history))
    text += ", and the direct answer stands against the history";
  else if (asymptote.confirmed_by_history && asymptote.holds_finer)
    text += ", settled by the history at these settings";
  for (const auto& [way, name] :
       {std::pair{wear::FoundBy::release, "the direct method"}, std::pair{wear::FoundBy::history, "the history"},
        std::pair{wear::FoundBy::finer_history, "one with more harmonics and samples"}})
    text += ends_words(name, way, asymptote.other_states);
  return text + "\n";
}

std::string summary(const WearQuestion& question, const WearAnswer& answer) {
  const char* unknown = answer.status == wear::Verdict::no_asymptote ? "none: wear goes on for ever" : "not known";
  const auto known = [&](double value, double WearBars::*bar) {
    if (!answer.known()) return std::string(unknown);
    std::string text = fmt::format("{:.6g}", value);
    if (!question.bars) return text;
    const double size = *question.bars.*bar;
    return text + (std::isfinite(size) ? fmt::format(" +- {:.2g}", size) : " +- not known");
  };
  const std::string status =
      std::string(to_string(answer.status)) + (answer.reason.empty() ? "" : " (" + answer.reason + ")");
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

/// What the user can do where a computation found no worn state.
std::string_view advice(const WearQuestion& question, const WearAnswer& answer) {
  if (answer.history && answer.history->end == wear::HistoryEnd::steps)
    return answer.choice.options.integrator == wear::IntegratorKind::implicit_steps
               ? ": allow more --steps"
               : ": allow more --steps, or a larger --increment of depth";
  if (question.follow == Drive::resonance && answer.solver == Status::no_bracket)
    return ": the resonance that was followed is no maximum any more, but a flank of a higher one; `backbone --over "
           "wear` shows the highest, --frequency HZ holds one";
  return "";
}

int verdict(const std::string& input, const WearQuestion& question, const WearAnswer& answer, const Streams& streams) {
  // Who asked for a number of cycles has them.
  const bool has_cycles = answer.history && answer.history->end == wear::HistoryEnd::cycles;
  if (answer.status != wear::Verdict::not_converged || has_cycles) return kDone;
  streams.err << fmt::format("dovetail: {}: the worn state did not converge: {}{}\n", input, to_string(answer.solver),
                             advice(question, answer));
  return kNotConverged;
}

/// The choices of the command line, or else of the study and what its law asks for: under a threshold nodes come to
/// rest in slip, and increments of depth end well beyond that.
WearOptions with_choices(WearOptions options, const LoadedModel& loaded) {
  if (!options.follow) options.follow = drive_of(loaded.follow);
  if (options.integrator) return options;
  const bool rests_in_slip = loaded.joint.model && wear::rests_in_slip(*loaded.joint.model);
  options.integrator = rests_in_slip && options.follow != Drive::resonance && !options.increment_m
                           ? wear::IntegratorKind::implicit_steps
                           : wear::IntegratorKind::explicit_jumps;
  return options;
}

/// What only the study and the model together can contradict.
void check_model(const WearOptions& options, const LoadedModel& loaded) {
  if (loaded.model.contact.count() == 0) refuse(options.input, "has no contact nodes: nothing can wear");
  if (options.follow != Drive::resonance) return;
  const std::string followed(to_string(Drive::resonance));
  if (options.integrator == wear::IntegratorKind::implicit_steps)
    refuse("--follow", "needs --integrator explicit", followed);
  if (loaded.model.mass.isZero(0.0))
    refuse("--follow", "needs a model with mass: a quasi-static one has no resonance", followed);
}

/// Where the wear begins; of a band, the frequency at which harmonics and samples are chosen.
WearStart begin(const WearOptions& options, const LoadedModel& loaded) {
  return options.follow == Drive::band ? wear_start_at((*options.band_from_hz + *options.band_to_hz) / 2)
                                       : wear_start(options, loaded);
}

/// What a computation of wear came to.
struct WearResult {
  WearQuestion question;
  WearAnswer answer;
  std::optional<WearBand> band = {};
};

/// Worn states that a spread computes, about: it foresees its time.
constexpr double kMembers = 12;

WearResult computed(const WearOptions& options, const LoadedModel& loaded, WearStart at, const wear::Watcher& watcher,
                    Teller& teller) {
  WearResult result{.question = {.frequency_hz = at.hz, .follow = *options.follow, .settings = loaded.joint.options},
                    .answer = {}};
  WearQuestion& question = result.question;
  WearAnswer& answer = result.answer;
  const auto begin = std::chrono::steady_clock::now();
  if (options.follow == Drive::band) {
    result.band = wear_band(options, loaded, watcher);
    answer = result.band->answer;
    if (!result.band->frequencies_hz.empty()) question.frequency_hz = result.band->frequencies_hz[result.band->worst];
    at = wear_start_at(question.frequency_hz);
  } else {
    answer = wear_answer(options, loaded, at, watcher);
  }
  if (answer.history && options.curves.value_or(0) > 0)
    answer.curves = worn_curves(options, loaded, *answer.history, watcher);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  const wear::Watcher quietly{.stop = watcher.stop, .progress = {}};
  if (options.error_bars) teller.begin("error bars");
  if (options.error_bars) question.bars = worn_bars(options, loaded, at, answer, quietly);
  if (options.spread) teller.begin("the spread", kMembers * seconds);
  if (options.spread) question.spread = worn_spread(options, loaded, at, answer, quietly);
  return result;
}

/// A computation that ends before it has a state leaves an answer, too.
WearResult without_state(const WearOptions& options, const LoadedModel& loaded, Status status, const std::string& why) {
  WearResult result{
      .question = {.frequency_hz = std::nan(""), .follow = *options.follow, .settings = loaded.joint.options},
      .answer = unknown_answer(options, loaded.model.contact.count(), status)};
  result.answer.reason = why;
  return result;
}

void present(const WearOptions& options, WearResult& result, const Streams& streams) {
  if (result.band) result.question.band = &*result.band;
  if (options.json.empty())
    streams.out << summary(result.question, result.answer);
  else
    deliver_json(options.json, wear_json(result.question, result.answer), streams);
}

}  // namespace

int run_wear(const WearOptions& given, Teller& teller, const Streams& streams) {
  std::optional<wear::Follow> follow;
  if (given.follow) follow = given.follow == Drive::resonance ? wear::Follow::resonance : wear::Follow::fixed;
  return answer_wear(given, told_model(given.input, given.set, given.solver, teller, follow), teller, streams);
}

int answer_wear(const WearOptions& given, LoadedModel loaded, Teller& teller, const Streams& streams) {
  const WearOptions options = with_choices(given, loaded);
  const auto failed = [&](const std::string& why) { return not_converged(options.input, why, streams); };
  const auto stateless = [&](Status status, const std::string& why, int solves) {
    WearResult result = without_state(options, loaded, status, why);
    result.answer.solves = solves;
    if (!options.json.empty()) present(options, result, streams);
    return failed("not converged: " + why);
  };
  if (!loaded.failure.empty()) return stateless(Status::iteration_limit, loaded.failure, 0);
  check_model(options, loaded);
  teller.begin("the unworn resonance");
  WearStart at = begin(options, loaded);
  std::optional<Status> automatic;
  if (at.found() && options.solver.automatic()) {
    automatic = choose_truncation(loaded, {at.hz}, options.solver);
    at = begin(options, loaded);
  }
  if (!at.found())
    return stateless(at.resonance->status,
                     "unworn resonance: " + std::string(to_string(at.resonance->status)) + "; give --frequency HZ",
                     at.resonance->solves);

  const OrderlyInterrupt interrupt;
  wear::Watcher watcher{.stop = [&] { return interrupt.requested(); }};
  watcher.progress = [&](int step, double volume, double rate) {
    std::string words =
        fmt::format("step {}, worn volume {:.4g} m^3, largest rate {:.3g} m per cycle", step, volume, rate);
    teller.status([said = std::move(words)](double) { return std::string(said); }, "the step of the history at hand");
  };
  teller.begin("the worn state");
  WearResult result = computed(options, loaded, at, watcher, teller);
  teller.end();
  if (automatic) result.question.automatic = WearQuestion::Automatic{*automatic, accuracy(options.solver)};
  present(options, result, streams);
  if (interrupt.requested()) return interrupted("the states found so far", streams);
  if (const int end = verdict(options.input, result.question, result.answer, streams); end != kDone) return end;
  if (automatic && *automatic != Status::converged)
    return failed(truncation_complaint(*automatic, loaded.joint.options, options.solver));
  if (const auto& spread = result.question.spread;
      spread && !spread->ranges.empty() && spread->ranges.back().failed > 0)
    return failed(fmt::format("{} of {} members of the spread did not converge", spread->ranges.back().failed,
                              spread->ranges.back().members));
  return kDone;
}

}  // namespace dovetail::studies
