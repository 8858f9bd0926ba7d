#include "studies/program/engine/wear_methods.hpp"

#include <algorithm>
#include <cmath>

#include "studies/program/engine/number_constants.hpp"
#include "studies/program/study_file/refusal.hpp"
#include "wear/asymptote/rest.hpp"

namespace dovetail::studies {

namespace {

constexpr const char* kCyclesReached = "the cycles asked for were reached while wearing";

WearAnswer by_history(const WearOptions& options, const LoadedModel& loaded, const WearStart& at,
                      const wear::Watcher& watcher) {
  ComputedHistory computed = compute_history(options, loaded, at, watcher);
  const bool held = computed.choice.options.follow == wear::Follow::fixed;
  WearAnswer answer;
  answer.history = std::move(computed.history);
  answer.choice = std::move(computed.choice);
  wear::History& history = *answer.history;
  if (at.resonance) history.solves += at.resonance->solves;
  answer.status = wear_status(history);
  if (history.end == wear::HistoryEnd::cycles) answer.reason = kCyclesReached;
  answer.solver = history.end == wear::HistoryEnd::steps ? Status::iteration_limit : history.status;
  answer.solves = history.solves;
  for (const double omega : history.frequency)
    answer.frequencies_hz.push_back(held && omega == at.omega ? at.hz : omega / kTurn);
  answer.volume = history.final_volume;
  answer.depth = history.final_depth;
  return answer;
}

WearAnswer by_asymptote(const WearOptions& options, const LoadedModel& loaded, const WearStart& at,
                        const wear::Watcher& watcher) {
  const steady::Condition& condition = loaded.joint.condition;
  const bool unchanged = condition.slip_origin.size() == 0 && condition.wear_depth.size() == 0;
  const steady::State* initial = at.resonance && unchanged ? &at.resonance->state : nullptr;
  wear::RestOptions settings;
  settings.follow = options.follow == Drive::resonance;
  settings.lines = loaded.lines;
  settings.asymptote.history_tolerance = options.history_tolerance.value_or(loaded.history_tolerance);
  wear::Rest found = wear::comes_to_rest(loaded.joint, at.omega, settings, initial, watcher);
  WearAnswer answer;
  answer.frequencies_hz = {at.hz};
  for (std::size_t i = 1; i < found.omegas.size(); ++i) answer.frequencies_hz.push_back(found.omegas[i] / kTurn);
  answer.solves = found.solves;
  answer.asymptote = std::move(found.asymptote);
  if (at.resonance) answer.solves += at.resonance->solves;
  answer.status = answer.asymptote->verdict;
  answer.solver = answer.asymptote->status;
  answer.volume = answer.asymptote->worn_volume;
  answer.depth = answer.asymptote->depth;
  return answer;
}

}  // namespace

WearStart wear_start_at(double hz) {
  return {.hz = hz, .omega = kTurn * hz, .resonance = {}};
}

WearStart wear_start(const WearOptions& options, const LoadedModel& loaded) {
  if (options.frequency_hz) return wear_start_at(*options.frequency_hz);
  if (!options.resume.empty())
    return wear_start_at(read_history(options.resume, loaded.joint.model->nodes()).frequency_hz);
  if (loaded.glued_omega <= 0) refuse(options.input, "has no natural frequency to start from; give --frequency HZ");
  if (loaded.model.output_names.empty())
    refuse(options.input, "has no output whose resonance could be found; give --frequency HZ");
  WearStart at;
  at.resonance = paths::resonance(loaded.joint, loaded.glued_omega);
  at.omega = at.resonance->omega;
  at.hz = at.omega / kTurn;
  return at;
}

wear::Verdict wear_status(const wear::History& history) {
  switch (history.end) {
    case wear::HistoryEnd::worn_out:
      return wear::Verdict::asymptote;
    case wear::HistoryEnd::steady_rate:
      return wear::Verdict::no_asymptote;
    default:
      return wear::Verdict::not_converged;
  }
}

WearAnswer unknown_answer(const WearOptions& options, Eigen::Index nodes, Status why) {
  const Eigen::VectorXd unknown = Eigen::VectorXd::Constant(nodes, kUnknown);
  WearAnswer answer;
  answer.solver = why;
  answer.depth = unknown;
  if (options.method == WearMethod::history) {
    wear::History& history = answer.history.emplace();
    history.status = why;
    history.end = why == Status::interrupted ? wear::HistoryEnd::interrupted : wear::HistoryEnd::failed;
    history.final_depth = unknown;
    if (options.integrator) answer.choice.options.integrator = *options.integrator;
  } else {
    wear::Asymptote& asymptote = answer.asymptote.emplace();
    asymptote.status = why;
    asymptote.depth = unknown;
    answer.frequencies_hz = {kUnknown};
  }
  return answer;
}

WearAnswer wear_answer(const WearOptions& options, const LoadedModel& loaded, const WearStart& at,
                       const wear::Watcher& watcher) {
  return options.method == WearMethod::history ? by_history(options, loaded, at, watcher)
                                               : by_asymptote(options, loaded, at, watcher);
}

WearBand wear_band(const WearOptions& options, const LoadedModel& loaded, const wear::Watcher& watcher) {
  WearBand band;
  band.answer = unknown_answer(options, loaded.joint.model->nodes(), Status::interrupted);
  double worst = -1;
  const int points = options.band_points.value_or(11);
  for (int i = 0; i < points && !watcher.stopped(); ++i) {
    const double part = points == 1 ? 0 : static_cast<double>(i) / (points - 1);
    const double hz = *options.band_from_hz + part * (*options.band_to_hz - *options.band_from_hz);
    WearAnswer answer = wear_answer(options, loaded, wear_start_at(hz), watcher);
    band.solves += answer.solves;
    band.frequencies_hz.push_back(hz);
    band.status.push_back(answer.status);
    band.volume.push_back(answer.worn_out() ? answer.volume : kUnknown);
    band.largest_depth.push_back(answer.worn_out() ? answer.depth.maxCoeff() : kUnknown);
    if (answer.status == wear::Verdict::not_converged) ++band.failed;
    if (answer.worn_out())
      band.envelope = band.envelope.size() > 0 ? band.envelope.cwiseMax(answer.depth).eval() : answer.depth;
    // Endless wear is worse than any volume; a failed one is only shown when there is nothing else.
    const double badness = answer.worn_out()                              ? answer.volume
                           : answer.status == wear::Verdict::no_asymptote ? kInfinity
                                                                          : -0.5;
    if (badness > worst) {
      worst = badness;
      band.worst = band.status.size() - 1;
      band.answer = std::move(answer);
    }
  }
  band.answer.solves = band.solves;
  // Where some frequencies are not known, which one is the worst is not known either.
  if (band.failed > 0 && band.answer.worn_out()) band.answer.status = wear::Verdict::not_converged;
  return band;
}

}  // namespace dovetail::studies
