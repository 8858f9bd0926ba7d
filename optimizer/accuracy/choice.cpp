#include "optimizer/accuracy/choice.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "optimizer/accuracy/params.hpp"
#include "optimizer/responses/response_table.hpp"
#include "optimizer/scene/scene_kind.hpp"

namespace dovetail::optimizer {

namespace {

constexpr SettingsParams kParams;

/// Which of the settings a part of a bar falls with.
enum class Knob { none, mesh, harmonics, samples, modes };

Knob knob_of(const std::string& source) {
  if (source == "mesh" || source == "contact_grid") return Knob::mesh;
  if (source == "harmonics" || source == "pseudo_penalty") return Knob::harmonics;
  if (source == "samples") return Knob::samples;
  if (source == "modes") return Knob::modes;
  return Knob::none;
}

/// What an evaluation at some settings foresees of others: bars by the orders in which their parts fall, seconds by the
/// powers in which theirs grow.
class Forecast {
 public:
  Forecast(const Scene& scene, const AccuracyGoal& goal, const Settings& at, const Evaluation& evaluation)
      : in_space_(scene.kind->in_space), at_(at), timings_(evaluation.timings_s) {
    std::vector<std::string> names = goal.responses;
    if (names.empty())
      for (const Response& response : responses()) names.emplace_back(response.name);
    for (const std::string& name : names) {
      const Response* response = find_response(name);
      const auto value = evaluation.responses.find(name);
      const auto bars = evaluation.error_sources.find(name);
      // A response without a value has no accuracy, one without a limit none that could be bought.
      if (response == nullptr || value == evaluation.responses.end() || bars == evaluation.error_sources.end() ||
          value->second == 0 || std::ranges::find(evaluation.unbounded, name) != evaluation.unbounded.end())
        continue;
      for (const auto& [source, bar] : bars->second)
        if (const Knob knob = knob_of(source); knob != Knob::none && bar > 0)
          parts_.push_back({.response = response,
                            .source = source,
                            .knob = knob,
                            .order = order(*response, source, knob),
                            .share = bar / std::abs(value->second) / goal.asked(name)});
    }
  }

  /// Largest bar over what is allowed of it.
  [[nodiscard]] double excess(const Settings& there) const {
    double largest = 0, sum = 0;
    const Response* of = nullptr;
    for (const Part& part : parts_) {
      if (part.response != of) sum = 0;
      of = part.response;
      sum += part.share * std::pow(finer(part.knob, there), -part.order);
      largest = std::max(largest, sum);
    }
    return largest;
  }

  [[nodiscard]] std::optional<Dominant> dominant(const AccuracyGoal& goal) const {
    std::map<const Response*, double> sums;
    for (const Part& part : parts_) sums[part.response] += part.share;
    const auto worst = std::ranges::max_element(sums, {}, [](const auto& s) { return s.second; });
    if (worst == sums.end()) return {};
    Dominant result{.response = std::string(worst->first->name)};
    double largest = 0;
    for (const Part& part : parts_)
      if (part.response == worst->first && part.share > largest) {
        largest = part.share;
        result.source = part.source;
      }
    result.asked = goal.asked(result.response);
    result.relative = worst->second * result.asked;
    return result;
  }

  [[nodiscard]] double seconds(const Settings& there) const {
    const auto spent = [this](std::initializer_list<const char*> stages) {
      double sum = 0;
      for (const char* stage : stages)
        if (const auto found = timings_.find(stage); found != timings_.end()) sum += found->second;
      return sum;
    };
    const double mesh = there.mesh / at_.mesh;
    const double modes = 1 - kParams.modes_share + kParams.modes_share * there.modes / at_.modes;
    const double unknowns = std::pow(mesh, in_space_ ? 2 : 1) * (2 * there.harmonics + 1) / (2 * at_.harmonics + 1);
    const double samples = unknowns * there.samples / at_.samples;
    const double matrices = spent({"feasibility", "mesh", "assembly", "prestress", "reduction", "stress"});
    const double contact = spent({"preload", "contact_fit", "unworn_resonance", "asymptote", "worn_resonance"});
    return matrices * modes * std::pow(mesh, in_space_ ? kParams.matrices_in_space : kParams.matrices) +
           contact * ((1 - kParams.contact_samples) * std::pow(unknowns, kParams.contact) +
                      kParams.contact_samples * samples);
  }

  /// Settings from which this one is not far enough to foresee nothing of them.
  [[nodiscard]] bool sees(const Settings& there) const {
    const double ratio = there.mesh / at_.mesh;
    return ratio <= kParams.step * (1 + 1e-9) && ratio >= 1 / kParams.step * (1 - 1e-9);
  }

 private:
  struct Part {
    const Response* response;
    std::string source;
    Knob knob;
    double order;
    double share;  ///< of the bar that is allowed
  };

  [[nodiscard]] double order(const Response& response, const std::string& source, Knob knob) const {
    switch (knob) {
      case Knob::mesh:
        if (source == "contact_grid") return response.grid_order;
        return in_space_ ? response.mesh_order.in_space : response.mesh_order.in_plane;
      case Knob::harmonics:
        return kParams.by_harmonics;
      case Knob::samples:
        return kParams.by_samples;
      case Knob::modes:
        return kParams.by_modes;
      case Knob::none:
        break;
    }
    return 0;
  }

  [[nodiscard]] double finer(Knob knob, const Settings& there) const {
    switch (knob) {
      case Knob::mesh:
        return there.mesh / at_.mesh;
      case Knob::harmonics:
        return (2.0 * there.harmonics + 1) / (2 * at_.harmonics + 1);
      case Knob::samples:
        return static_cast<double>(there.samples) / at_.samples;
      case Knob::modes:
        return static_cast<double>(there.modes) / at_.modes;
      case Knob::none:
        break;
    }
    return 1;
  }

  bool in_space_;
  Settings at_;
  std::map<std::string, double> timings_;
  std::vector<Part> parts_;  // those of a response one after the other
};

/// The cheapest that should do; where none should, the most accurate.
Settings cheapest(const std::vector<Settings>& all, const Forecast& forecast, double allowed, bool far) {
  const Settings* best = nullptr;
  std::pair<double, double> least;  // excess beyond what is allowed, seconds
  for (const Settings& settings : all) {
    if (!far && !forecast.sees(settings)) continue;
    const std::pair<double, double> rank{std::max(0.0, forecast.excess(settings) - allowed),
                                         forecast.seconds(settings)};
    if (best != nullptr && rank >= least) continue;
    best = &settings;
    least = rank;
  }
  return *best;
}

std::optional<SettingsChoice::Digit> one_more_digit(const std::vector<Settings>& all, const Forecast& forecast,
                                                    const SettingsChoice& choice) {
  const double tenth = choice.tried.excess / 10;
  const Settings there = cheapest(all, forecast, tenth, true);
  if (forecast.excess(there) > tenth) return {};
  return SettingsChoice::Digit{.settings = there,
                               .times_as_long = forecast.seconds(there) / forecast.seconds(choice.settings)};
}

bool better(const SettingsTried& a, const SettingsTried& b) {
  const bool a_does = a.excess <= 1, b_does = b.excess <= 1;
  if (a_does != b_does) return a_does;
  return a_does ? a.seconds < b.seconds : a.excess < b.excess;
}

}  // namespace

SettingsChoice choose_settings(const Scene& scene, const AccuracyGoal& goal, const AccuracyProbe& probe,
                               const AccuracyListener& told) {
  std::vector<Settings> all = all_settings(scene, goal.fixed);
  SettingsChoice choice;
  choice.settings = settings_of(scene);
  std::optional<Forecast> best, forecast;  // at the settings chosen so far, and at the last ones
  Settings next = choice.settings;
  if (std::ranges::find(all, next) == all.end()) next = all.front();  // samples that alias
  for (int round = 0; round < kParams.rounds; ++round) {
    const CandidateResult result = probe(next);
    const Evaluation& evaluation = result.evaluation;
    SettingsTried tried{.settings = next, .status = evaluation.status, .excess = kInfinity};
    double without_bars = evaluation.timings_s.contains("total") ? evaluation.timings_s.at("total") : 0;
    if (const auto bars = evaluation.timings_s.find("error_estimates"); bars != evaluation.timings_s.end())
      without_bars -= bars->second;
    tried.seconds = without_bars;
    if (evaluation.converged()) {
      forecast.emplace(scene, goal, next, evaluation);
      tried.excess = forecast->excess(next);
      tried.by = forecast->dominant(goal);
    } else {
      std::erase(all, next);
    }
    choice.rounds.push_back(tried);
    if (told) told(tried);
    if (!forecast) break;
    if (evaluation.converged() && (!best || better(tried, choice.tried))) {
      choice.settings = next;
      choice.tried = tried;
      choice.evaluation = evaluation;
      best = forecast;
    }
    const Settings wanted = cheapest(all, *forecast, kParams.aim, false);
    const bool known = std::ranges::any_of(choice.rounds, [&](const SettingsTried& t) { return t.settings == wanted; });
    const bool hardly_cheaper =
        tried.excess <= 1 && forecast->seconds(wanted) > kParams.worth * forecast->seconds(next);
    if (known || hardly_cheaper) break;
    next = wanted;
  }
  if (!best) {
    choice.status = Status::stalled;
    return choice;
  }
  choice.status = choice.tried.excess <= 1 ? Status::converged : Status::iteration_limit;
  choice.one_more_digit = one_more_digit(all, *best, choice);
  return choice;
}

SettingsChoice choose_settings(const Scene& reference, const Scene& scene, const AccuracyGoal& goal,
                               const AccuracyListener& told) {
  Purpose purpose{.bars = true, .history = false};
  if (!goal.responses.empty()) purpose.until = last_stage(goal.responses);
  return choose_settings(
      scene, goal,
      [&](const Settings& settings) {
        return SceneEvaluator(with_settings(reference, settings)).evaluate(with_settings(scene, settings), purpose);
      },
      told);
}

}  // namespace dovetail::optimizer
