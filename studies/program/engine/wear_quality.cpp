#include "studies/program/engine/wear_quality.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "paths/resonance.hpp"
#include "paths/steady_state.hpp"
#include "quality/truncation.hpp"

namespace dovetail::studies {
namespace {

/// What is left of a worn state for its error bars; NaN where wear did not come to an end.
struct WornState {
  double volume = std::nan(""), depth = std::nan("");
};

WornState worn_state(const WearAnswer& answer) {
  return answer.worn_out() ? WornState{.volume = answer.volume, .depth = answer.largest_depth()} : WornState{};
}

/// By how much histories end away from a direct answer that stands against them.
WornState history_apart(const WearAnswer& answer) {
  WornState apart{.volume = 0, .depth = 0};
  if (!answer.asymptote || answer.asymptote->decided_by != wear::FoundBy::release) return apart;
  for (const wear::OtherState& other : answer.asymptote->other_states) {
    if (other.found_by != wear::FoundBy::history && other.found_by != wear::FoundBy::finer_history) continue;
    apart.volume = std::max(apart.volume, std::abs(other.worn_volume - answer.volume));
    apart.depth = std::max(apart.depth, std::abs(other.largest_depth - answer.largest_depth()));
  }
  return apart;
}

wear::WornEnd worn_end(const WearAnswer& answer) {
  return {.verdict = answer.status,
          .status = answer.solver,
          .volume = answer.volume,
          .depth = answer.depth,
          .solves = answer.solves};
}

}  // namespace

WearBars worn_bars(const WearOptions& options, const LoadedModel& loaded, const WearStart& at, const WearAnswer& answer,
                   const wear::Watcher& watcher) {
  const auto changed = [&](steady::Options settings) {
    if (watcher.stopped()) return WornState{};
    LoadedModel again = loaded;
    again.joint.options = std::move(settings);
    const WearStart from = options.follow == Drive::band ? at : wear_start(options, again);
    return from.found() ? worn_state(wear_answer(options, again, from, watcher)) : WornState{};
  };
  const auto scaled = [&](double ratio) {
    steady::Options settings = loaded.joint.options;
    settings.penalty_scale *= ratio;
    return changed(settings);
  };
  const WornState nominal = worn_state(answer);
  const WornState harmonics = changed(quality::more_harmonics(loaded.joint.options));
  const WornState samples = changed(quality::more_samples(loaded.joint.options));
  const WornState softer = scaled(0.5), stiffer = scaled(2), histories = history_apart(answer);
  const auto bar = [&](double WornState::*value) {
    const auto change = [&](const WornState& other) {
      const double difference = std::abs(other.*value - nominal.*value);
      return std::isnan(difference) ? kInfinity : difference;  // not computed: unknown
    };
    return histories.*value + quality::bar_from({.harmonics = change(harmonics),
                                                 .samples = change(samples),
                                                 .softer = change(softer),
                                                 .stiffer = change(stiffer)},
                                                loaded.joint.model->massless_contact());
  };
  return {.worn_volume = bar(&WornState::volume), .largest_depth = bar(&WornState::depth)};
}

wear::Spread worn_spread(const WearOptions& options, const LoadedModel& loaded, const WearStart& at,
                         const WearAnswer& answer, const wear::Watcher& watcher) {
  const steady::State unworn = at.resonance ? at.resonance->state : paths::steady_state(loaded.joint, at.omega);
  const auto compute = [&](const steady::Joint& joint) {
    wear::WornEnd failed;
    failed.status = Status::interrupted;
    if (watcher.stopped()) return failed;
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
    return worn_end(wear_answer(options, changed, from, watcher));
  };
  const bool solved = unworn.status == Status::converged;
  return wear::spread(loaded.joint, worn_end(answer), compute, solved ? &unworn : nullptr);
}

}  // namespace dovetail::studies
