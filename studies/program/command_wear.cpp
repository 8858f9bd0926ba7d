#include <fmt/format.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <optional>
#include <ostream>

#include "response/resonance.hpp"
#include "response/truncation.hpp"
#include "studies/program/commands.hpp"
#include "studies/program/engine.hpp"
#include "studies/program/interrupt.hpp"
#include "studies/program/json.hpp"
#include "studies/program/progress.hpp"
#include "studies/program/truncation_choice.hpp"

namespace dovetail::studies {
namespace {

constexpr double kTurn = 2 * std::numbers::pi;
/// Successive asymptotes at most while the resonance is followed, and the change of frequency that ends them.
constexpr int kFollowPasses = 30;
constexpr double kFollowTolerance = 1e-7;

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
  if (options.method != "history" && (options.cycles || options.steps || options.increment_m))
    bad("--cycles, --steps, --increment", "", "only have a meaning with --method history");
  if (!found.empty()) throw InputError(std::move(found));
}

struct Start {
  double hz = 0;  ///< exactly as asked for
  double omega = 0;
  std::optional<response::Resonance> resonance;
};

/// The frequency asked for, or the unworn resonance.
Start start(const WearOptions& options, const LoadedModel& loaded) {
  Start at;
  if (options.frequency_hz) {
    at.hz = *options.frequency_hz;
    at.omega = kTurn * at.hz;
    return at;
  }
  if (loaded.glued_omega <= 0)
    throw InputError(Violation{.file = {},
                               .key = options.input,
                               .value = {},
                               .allowed = "has no natural frequency to start from; give --frequency HZ"});
  if (loaded.model.output_names.empty())
    throw InputError(Violation{.file = {},
                               .key = options.input,
                               .value = {},
                               .allowed = "has no output whose resonance could be found; give --frequency HZ"});
  at.resonance = response::resonance(loaded.condensed, loaded.glued_omega, {}, loaded.steady);
  at.omega = at.resonance->omega;
  at.hz = at.omega / kTurn;
  return at;
}

struct FollowedAsymptote {
  wear::Asymptote asymptote;
  std::vector<double> frequencies_hz;
  int solves = 0;
};

/// The asymptote at the start's frequency and, when the resonance is followed, on from there at the resonance of the
/// worn joint until that stays.
FollowedAsymptote asymptote(const WearOptions& options, const LoadedModel& loaded, const Start& at,
                            const wear::Control& control) {
  FollowedAsymptote result;
  const response::SteadyState* initial = at.resonance ? &at.resonance->state : nullptr;
  result.solves = at.resonance ? at.resonance->solves : 0;
  result.asymptote = wear::asymptote(loaded.condensed, at.omega, {}, loaded.steady, {}, initial, control);
  result.frequencies_hz = {at.hz};
  result.solves += result.asymptote.solves;
  if (options.follow == "fixed") return result;

  double omega = at.omega;
  for (int pass = 0; pass < kFollowPasses && result.asymptote.verdict == wear::Verdict::asymptote; ++pass) {
    response::ContactCondition condition;
    condition.wear_depth = result.asymptote.depth;
    const response::Resonance worn = response::resonance(loaded.condensed, omega, condition, loaded.steady);
    result.solves += worn.solves;
    if (worn.status != Status::converged) {
      result.asymptote.verdict = wear::Verdict::not_converged;
      result.asymptote.status = worn.status;
      return result;
    }
    const bool stays = std::abs(worn.omega / omega - 1) < kFollowTolerance;
    omega = worn.omega;
    if (stays) return result;
    result.asymptote = wear::asymptote(loaded.condensed, omega, condition, loaded.steady, {}, nullptr, control);
    result.solves += result.asymptote.solves;
    result.frequencies_hz.push_back(omega / kTurn);
  }
  if (result.asymptote.verdict == wear::Verdict::asymptote) {
    result.asymptote.verdict = wear::Verdict::not_converged;
    result.asymptote.status = Status::iteration_limit;
  }
  return result;
}

/// What is left of a worn state for its error bars; NaN where wear did not come to an end.
struct WornState {
  double volume = std::nan(""), depth = std::nan("");
};

/// Error bars of a worn state: it is computed again from the start at the settings of response::error_bars.
WearBars worn_bars(const LoadedModel& loaded, const WornState& nominal,
                   const std::function<WornState(const LoadedModel&)>& compute) {
  const auto changed = [&](response::SteadyOptions settings) {
    LoadedModel again = loaded;
    again.steady = std::move(settings);
    return compute(again);
  };
  const auto scaled = [&](double ratio) {
    response::SteadyOptions settings = loaded.steady;
    settings.penalty_scale *= ratio;
    return changed(settings);
  };
  const WornState harmonics = changed(response::more_harmonics(loaded.steady));
  const WornState samples = changed(response::more_samples(loaded.steady));
  const WornState softer = scaled(0.5), stiffer = scaled(2);
  const auto bar = [&](double WornState::*value) {
    const auto change = [&](const WornState& other) {
      const double difference = std::abs(other.*value - nominal.*value);
      return std::isnan(difference) ? kInfinity : difference;  // not computed: unknown
    };
    return response::bar_from({.harmonics = change(harmonics),
                               .samples = change(samples),
                               .softer = change(softer),
                               .stiffer = change(stiffer)},
                              loaded.condensed->massless_contact());
  };
  return {.worn_volume = bar(&WornState::volume), .largest_depth = bar(&WornState::depth)};
}

std::string summary(const std::string& status, double hz, const std::string& follow, double volume, double depth,
                    int solves) {
  return fmt::format(
      "status          {}\nfrequency_hz    {:.9g} ({})\nworn_volume_m3  {:.6g}\nlargest_depth_m {:.6g}\nsolves         "
      " {}\n",
      status, hz, follow == "fixed" ? "held" : "following the resonance", volume, depth, solves);
}

double largest(const Eigen::VectorXd& depth) {
  return depth.size() > 0 ? depth.maxCoeff() : 0;
}

int verdict(const std::string& input, const std::string& status, Status solver, bool interrupted,
            const Streams& streams) {
  if (interrupted) return kInterrupted;
  if (status != "not_converged") return kDone;
  streams.err << fmt::format("dovetail: {}: the worn state did not converge: {}\n", input, to_string(solver));
  return kNotConverged;
}

/// The two methods behind one face.
struct Answer {
  std::string json, status;
  Status solver = Status::converged;
  WornState worn;
  double volume = 0, depth = 0;  ///< of the last state, worn out or not
  int solves = 0;
};

using JsonQuestion = std::function<WearQuestion(const WornState&)>;

Answer by_history(const WearOptions& options, const LoadedModel& loaded, const Start& at, const wear::Control& control,
                  const JsonQuestion& question) {
  wear::HistoryOptions settings;
  settings.follow = options.follow;
  settings.cycles = options.cycles.value_or(settings.cycles);
  settings.steps = options.steps.value_or(settings.steps);
  settings.increment = options.increment_m.value_or(settings.increment);
  wear::History history = wear::history(loaded.condensed, at.omega, {}, loaded.steady, settings, {}, control);
  if (at.resonance) history.solves += at.resonance->solves;
  Answer answer;
  answer.status = wear_status(history);
  answer.solver = history.end == wear::HistoryEnd::steps ? Status::iteration_limit : history.status;
  answer.solves = history.solves;
  if (const Eigen::Index last = history.depth.rows() - 1; last >= 0) {
    answer.volume = history.worn_volume[last];
    answer.depth = largest(history.depth.row(last).transpose());
    if (answer.status != "not_converged") answer.worn = {.volume = answer.volume, .depth = answer.depth};
  }
  if (question) answer.json = history_json(question(answer.worn), history);
  return answer;
}

Answer by_asymptote(const WearOptions& options, const LoadedModel& loaded, const Start& at,
                    const wear::Control& control, const JsonQuestion& question) {
  const FollowedAsymptote found = asymptote(options, loaded, at, control);
  Answer answer;
  answer.status = std::string(wear::to_string(found.asymptote.verdict));
  answer.solver = found.asymptote.status;
  answer.solves = found.solves;
  answer.volume = found.asymptote.worn_volume;
  answer.depth = largest(found.asymptote.depth);
  if (answer.status == "asymptote") answer.worn = {.volume = answer.volume, .depth = answer.depth};
  if (question)
    answer.json = asymptote_json(question(answer.worn), found.asymptote, found.frequencies_hz, found.solves);
  return answer;
}

}  // namespace

int run_wear(const WearOptions& options, const Streams& streams) {
  validate(options);
  check_accuracy(options.solver);
  LoadedModel loaded = load_model(options.input, options.overrides, options.solver);
  const auto failed = [&](const std::string& why) {
    streams.err << "dovetail: " << options.input << ": " << why << "\n";
    return static_cast<int>(kNotConverged);
  };
  if (!loaded.failure.empty()) return failed("not converged: " + loaded.failure);
  if (loaded.model.contact.count() == 0)
    throw InputError(
        Violation{.file = {}, .key = options.input, .value = {}, .allowed = "has no contact nodes: nothing can wear"});
  Start at = start(options, loaded);
  const auto found = [&] { return !at.resonance || at.resonance->status == Status::converged; };
  std::optional<Status> automatic;
  if (found() && options.solver.automatic()) {
    automatic = choose_truncation(loaded, {at.hz}, options.solver);
    at = start(options, loaded);
  }
  if (!found())
    return failed("not converged: unworn resonance: " + std::string(to_string(at.resonance->status)) +
                  "; give --frequency HZ");

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
  const auto compute = [&](const LoadedModel& model, const Start& from, const JsonQuestion& question) {
    return options.method == "history" ? by_history(options, model, from, control, question)
                                       : by_asymptote(options, model, from, control, question);
  };
  const auto again = [&](const LoadedModel& model) {
    if (interrupt.requested()) return WornState{};
    const Start from = start(options, model);
    if (from.resonance && from.resonance->status != Status::converged) return WornState{};
    return compute(model, from, {}).worn;
  };
  const Answer answer = compute(loaded, at, [&](const WornState& worn) {
    WearQuestion question{.frequency_hz = at.hz, .follow = options.follow, .settings = loaded.steady};
    if (automatic) question.automatic = WearQuestion::Automatic{*automatic, accuracy(options.solver)};
    if (options.error_bars) question.bars = worn_bars(loaded, worn, again);
    return question;
  });
  if (terminal) streams.err << "\r\033[K" << std::flush;
  deliver_json(options.json, answer.json, streams);
  if (options.json.empty())
    streams.out << summary(answer.status, at.hz, options.follow, answer.volume, answer.depth, answer.solves);
  const int end = verdict(options.input, answer.status, answer.solver, interrupt.requested(), streams);
  if (end == kDone && automatic && *automatic != Status::converged)
    return failed(truncation_complaint(*automatic, loaded.steady, options.solver));
  return end;
}

}  // namespace dovetail::studies
