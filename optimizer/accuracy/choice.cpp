#include "optimizer/accuracy/choice.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "optimizer/accuracy/params.hpp"
#include "optimizer/responses/response_table.hpp"
#include "optimizer/scene/scene_kind.hpp"
#include "steady/work.hpp"

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

/// Of every knob, over what it is elsewhere: larger is finer.
double finer(Knob knob, const Settings& there, const Settings& here) {
  switch (knob) {
    case Knob::mesh:
      return there.mesh / here.mesh;
    case Knob::harmonics:
      return (2.0 * there.harmonics + 1) / (2 * here.harmonics + 1);
    case Knob::samples:
      return static_cast<double>(there.samples) / here.samples;
    case Knob::modes:
      return static_cast<double>(there.modes) / here.modes;
    case Knob::none:
      break;
  }
  return 1;
}

/// What evaluations with bars foresee of other settings: bars by the orders in which their parts fall, operations by
/// the powers in which theirs grow.
class Forecast {
 public:
  Forecast(const Scene& scene, const AccuracyGoal& goal) : goal_(&goal), in_space_(scene.kind->in_space) {}

  /// The last one is what others are foreseen from. Where one before it differs in a knob the two say the order of a
  /// part.
  void add(const Settings& at, const Evaluation& evaluation) {
    const std::vector<Part> before = std::exchange(parts_, {});
    const Settings was = std::exchange(at_, at);
    dofs_ = evaluation.model.at("dofs");
    const auto nodes = static_cast<Eigen::Index>(evaluation.model.at("contact_nodes"));
    const Eigen::Index directions = in_space_ ? 3 : 2;
    const double jacobian = steady::jacobian_operations(nodes, directions, at.harmonics, at.samples);
    const double factorisation = steady::factorisation_operations(nodes * directions * (2 * at.harmonics + 1));
    factorisations_ = evaluation.model.at("jacobians_spent") * factorisation;
    marches_ = evaluation.model.at("jacobians_spent") * (jacobian - factorisation);
    std::vector<std::string> names = goal_->responses;
    if (names.empty())
      for (const Response& response : responses()) names.emplace_back(response.name);
    for (const std::string& name : names)
      if (const Response* response = find_response(name)) add(*response, evaluation);
    for (Part& part : parts_)
      for (const Part& old : before) {
        if (part.response != old.response || part.source != old.source) continue;
        part.order = old.order;
        const double ratio = finer(part.knob, at_, was), expected = order(*part.response, part.source, part.knob);
        if (ratio != 1 && old.share > 0 && part.share > 0)
          part.order = std::clamp(std::log(old.share / part.share) / std::log(ratio), expected / kParams.order_off,
                                  expected * kParams.order_off);
      }
  }

  /// Responses asked for by name of which nothing is known.
  [[nodiscard]] std::vector<std::string> not_held() const {
    std::vector<std::string> names;
    for (const std::string& name : goal_->responses)
      if (std::ranges::none_of(parts_, [&](const Part& part) { return part.response->name == name; }))
        names.push_back(name);
    return names;
  }

  /// Largest bar over what is allowed of it.
  [[nodiscard]] double excess(const Settings& there) const {
    double largest = 0, sum = 0;
    const Response* of = nullptr;
    for (const Part& part : parts_) {
      if (part.response != of) sum = 0;
      of = part.response;
      sum += part.share * std::pow(finer(part.knob, there, at_), -part.order);
      largest = std::max(largest, sum);
    }
    return largest;
  }

  [[nodiscard]] std::optional<Dominant> dominant() const {
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
    result.asked = goal_->asked(result.response);
    result.relative = worst->second * result.asked;
    result.whole = whole_.at(result.response);
    return result;
  }

  /// Of an evaluation without bars. Counted and not timed, so that the same is chosen on every machine.
  [[nodiscard]] double operations(const Settings& there) const {
    const double mesh = there.mesh / at_.mesh;
    const double dofs = dofs_ * std::pow(mesh, in_space_ ? kParams.dofs_in_space : kParams.dofs);
    const double matrices = (in_space_ ? kParams.matrices_by_in_space : kParams.matrices_by) *
                            std::pow(dofs, in_space_ ? kParams.matrices_in_space : kParams.matrices_in_plane) *
                            (1 - kParams.modes_share + kParams.modes_share * there.modes / kParams.modes);
    const double unknowns = std::pow(mesh, in_space_ ? 2 : 1) * finer(Knob::harmonics, there, at_);
    return matrices + factorisations_ * std::pow(unknowns, kParams.contact) +
           marches_ * unknowns * finer(Knob::samples, there, at_);
  }

  [[nodiscard]] const Settings& at() const { return at_; }

 private:
  struct Part {
    const Response* response;
    std::string source;
    Knob knob;
    double order;
    double share;  ///< of the bar that is allowed
  };

  /// A response without a value has no accuracy, one without a limit none that could be bought.
  void add(const Response& response, const Evaluation& evaluation) {
    const std::string name(response.name);
    const auto value = evaluation.responses.find(name);
    const auto bars = evaluation.error_sources.find(name);
    if (value == evaluation.responses.end() || value->second == 0 || bars == evaluation.error_sources.end() ||
        std::ranges::find(evaluation.unbounded, name) != evaluation.unbounded.end())
      return;
    double whole = 0;
    for (const auto& [source, bar] : bars->second)
      if (source != "history") whole += bar;  // no round asks a history: what it would settle is not known here
    whole_[name] = whole / std::abs(value->second);
    for (const auto& [source, bar] : bars->second)
      if (const Knob knob = knob_of(source); knob != Knob::none)
        parts_.push_back({.response = &response,
                          .source = source,
                          .knob = knob,
                          .order = order(response, source, knob),
                          .share = bar / std::abs(value->second) / goal_->asked(name)});
  }

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

  const AccuracyGoal* goal_;
  bool in_space_;
  Settings at_;
  double dofs_ = 0;                          // unknowns of the mesh
  double factorisations_ = 0, marches_ = 0;  // operations of all that follows the matrices
  std::map<std::string, double> whole_;  // bars over values, with what no setting buys but what a history would settle
  std::vector<Part> parts_;              // those of a response one after the other
};

constexpr std::array kKnobs{Knob::mesh, Knob::harmonics, Knob::samples, Knob::modes};

/// The cheapest that should do; where none should, of those that are as good as the most accurate one.
Settings cheapest(const std::vector<Settings>& all, const Forecast& forecast, double allowed) {
  std::vector<double> excess;
  for (const Settings& settings : all) excess.push_back(forecast.excess(settings));
  const double least = *std::ranges::min_element(excess);
  const double limit = least <= allowed ? allowed : kParams.as_good * least;
  std::size_t best = 0;
  for (std::size_t i = 0; i < all.size(); ++i)
    if (excess[i] <= limit && (excess[best] > limit || forecast.operations(all[i]) < forecast.operations(all[best])))
      best = i;
  return all[best];
}

/// On the way there no further than may be foreseen.
Settings towards(const Settings& there, const std::vector<Settings>& all, const Settings& at) {
  const auto rank = [&](const Settings& settings) {
    double too_far = 0, away = 0;
    for (const Knob knob : kKnobs) {
      too_far += std::max(0.0, std::abs(std::log(finer(knob, settings, at))) - std::log(kParams.step));
      away += std::abs(std::log(finer(knob, settings, there)));
    }
    return std::pair{too_far, away};
  };
  return *std::ranges::min_element(all, {}, rank);
}

std::optional<SettingsChoice::Digit> one_more_digit(const std::vector<Settings>& all, const Forecast& forecast,
                                                    const SettingsChoice& choice) {
  const double tenth = choice.tried.excess / 10;
  const Settings there = cheapest(all, forecast, tenth);
  if (forecast.excess(there) > tenth) return {};
  return SettingsChoice::Digit{.settings = there,
                               .times_as_long = forecast.operations(there) / forecast.operations(choice.settings)};
}

bool better(const SettingsTried& a, const SettingsTried& b) {
  const bool a_does = a.excess <= 1, b_does = b.excess <= 1;
  if (a_does != b_does) return a_does;
  return a_does ? a.operations < b.operations : a.excess < b.excess;
}

}  // namespace

SettingsChoice choose_settings(const Scene& scene, const AccuracyGoal& goal, const AccuracyProbe& probe,
                               const AccuracyListener& told) {
  std::vector<Settings> all = all_settings(scene, goal.fixed);
  SettingsChoice choice;
  choice.settings = settings_of(scene);
  Forecast forecast(scene, goal);
  std::optional<Forecast> best;
  Settings next = choice.settings;
  if (std::ranges::find(all, next) == all.end()) next = all.front();  // samples that alias
  for (int round = 0; round < kParams.rounds; ++round) {
    const Evaluation evaluation = probe(next);
    SettingsTried tried{.settings = next, .status = evaluation.status};
    if (evaluation.converged()) {
      forecast.add(next, evaluation);
      tried.by = forecast.dominant();
      if (tried.by) tried.excess = forecast.excess(next);
      tried.operations = forecast.operations(next);
      if (!best) choice.not_held = forecast.not_held();
    }
    if (tried.by) {
      if (!best || better(tried, choice.tried)) {
        choice.settings = next;
        choice.tried = tried;
        choice.evaluation = evaluation;
        choice.not_held = forecast.not_held();
        best = forecast;
      }
    } else {
      std::erase(all, next);
    }
    choice.rounds.push_back(tried);
    if (told) told(tried);
    if (!best) break;
    const Settings wanted = towards(cheapest(all, forecast, kParams.aim), all, next);
    const bool known = std::ranges::any_of(choice.rounds, [&](const SettingsTried& t) { return t.settings == wanted; });
    const bool hardly_cheaper =
        choice.tried.excess <= 1 && forecast.operations(wanted) > kParams.worth * choice.tried.operations;
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
        return SceneEvaluator(with_settings(reference, settings))
            .evaluate(with_settings(scene, settings), purpose)
            .evaluation;
      },
      told);
}

}  // namespace dovetail::optimizer
