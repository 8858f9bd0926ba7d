#include "optimizer/accuracy/forecast.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "optimizer/accuracy/params.hpp"
#include "optimizer/responses/response_table.hpp"
#include "optimizer/scene/scene_kind.hpp"
#include "steady/work.hpp"

namespace dovetail::optimizer {

namespace {

constexpr SettingsParams kForecast;

Knob knob_of(const std::string& source) {
  if (source == "mesh" || source == "contact_grid" || source == "zone_ends") return Knob::mesh;
  if (source == "harmonics" || source == "pseudo_penalty") return Knob::harmonics;
  if (source == "samples") return Knob::samples;
  if (source == "modes") return Knob::modes;
  if (source == "search") return Knob::resonance;
  return Knob::none;
}

/// Whether a part of a bar that falls with `knob` is held to what was asked for.
bool counts(Knob knob, const AccuracyGoal& goal) {
  if (goal.of_truncation) return knob == Knob::harmonics || knob == Knob::samples;
  return knob != Knob::none;
}

/// To whose number that of steady states is proportional.
double states_by(const Settings& settings) {
  return 1 - kForecast.by_digit * (std::log10(settings.resonance_tolerance) - std::log10(kForecast.coarsest_tolerance));
}

}  // namespace

double finer(Knob knob, const Settings& there, const Settings& here) {
  switch (knob) {
    case Knob::mesh:
      return there.mesh / here.mesh;
    case Knob::beside:
      return there.beside / here.beside;
    case Knob::harmonics:
      return (2.0 * there.harmonics + 1) / (2 * here.harmonics + 1);
    case Knob::samples:
      return static_cast<double>(there.samples) / here.samples;
    case Knob::modes:
      return static_cast<double>(there.modes) / here.modes;
    case Knob::resonance:
      return here.resonance_tolerance / there.resonance_tolerance;
    case Knob::none:
      break;
  }
  return 1;
}

Forecast::Forecast(const Scene& scene, const AccuracyGoal& goal)
    : scene_(&scene), goal_(&goal), in_space_(scene.kind->in_space) {}

void raise_bars(const BarParts& least, Evaluation& evaluation) {
  for (const auto& [name, parts] : least) {
    const auto value = evaluation.responses.find(name);
    const auto bars = evaluation.error_sources.find(name);
    if (value == evaluation.responses.end() || bars == evaluation.error_sources.end() ||
        std::ranges::find(evaluation.unbounded, name) != evaluation.unbounded.end())
      continue;
    for (const auto& [source, relative] : parts) {
      double& bar = bars->second[source];
      const double more = relative * std::abs(value->second) - bar;
      if (more <= 0) continue;
      bar += more;
      if (const auto sum = evaluation.error_estimates.find(name); sum != evaluation.error_estimates.end())
        sum->second += more;
    }
  }
}

const Forecast::Part* Forecast::Round::find(const Part& like) const {
  const auto found = std::ranges::find_if(parts, [&](const Part& part) {
    return part.response == like.response && part.source == like.source && part.knob == like.knob;
  });
  return found == parts.end() ? nullptr : &*found;
}

double Forecast::expected(const Part& of, const Round& by) const {
  const Part* there = by.find(of);
  if (there == nullptr) return kInfinity;
  return there->share * std::pow(finer(of.knob, last_.at, by.at), -order(*of.response, of.source, of.knob));
}

void Forecast::raise(Part& part, double share) {
  const std::string name(part.response->name);
  whole_.at(name) += (share - part.share) * goal_->asked(name);
  part.share = share;
  part.raised = true;
}

void Forecast::add(const Settings& at, const Evaluation& evaluation, const std::map<std::string, double>& beside) {
  const Round one_more = std::exchange(before_, std::exchange(last_, {.at = at, .parts = {}}));
  whole_.clear();
  known_.clear();
  unresolved_.clear();
  dofs_ = evaluation.model.at("dofs");
  const auto nodes = static_cast<Eigen::Index>(evaluation.model.at("contact_nodes"));
  contact_ = evaluation.model.at("jacobians_spent") *
             steady::jacobian_operations(nodes, in_space_ ? 3 : 2, at.harmonics, at.samples);
  std::vector<std::string> names = goal_->responses;
  if (names.empty())
    for (const Response& response : responses()) names.emplace_back(response.name);
  for (const std::string& name : names) {
    const auto part = beside.find(name);
    if (const Response* response = find_response(name))
      add(*response, evaluation, part == beside.end() ? std::nullopt : std::optional(part->second));
  }
  for (Part& part : last_.parts) {
    const Part* old = before_.find(part);
    if (old == nullptr) continue;
    part.order = old->order;
    // One round of two before may be out of line.
    const double least = std::min(expected(part, before_), expected(part, one_more));
    if (const double mean = std::sqrt(least * part.share); mean > part.share) raise(part, mean);
    // A part that grows where it should fall is off by more than its order could say.
    const double ratio = finer(part.knob, last_.at, before_.at),
                 by_itself = order(*part.response, part.source, part.knob);
    if (ratio != 1 && old->share > 0 && part.share > 0 && (old->share > part.share) == (ratio > 1))
      part.order = std::clamp(std::log(old->share / part.share) / std::log(ratio), by_itself / kForecast.order_off,
                              by_itself * kForecast.order_off);
  }
}

bool Forecast::meets(const Forecast& other) const {
  return std::ranges::all_of(known_, [&](const auto& of) {
    const auto there = other.known_.find(of.first);
    return there == other.known_.end() ||
           std::abs(of.second.value - there->second.value) <= of.second.bar + there->second.bar;
  });
}

void Forecast::reach(const Forecast& other) {
  for (const auto& [name, own] : known_) {
    const auto there = other.known_.find(name);
    if (there == other.known_.end()) continue;
    const double more =
        (std::abs(own.value - there->second.value) - there->second.bar) / std::abs(own.value) - whole_.at(name);
    if (more <= 0) continue;
    // What most of the other is that differs in between, or else what most of its own is.
    const auto weight = [&](const Part& part) {
      const Part* of_other = other.last_.find(part);
      const bool differs = of_other != nullptr && finer(part.knob, other.last_.at, last_.at) != 1;
      return std::pair{differs ? of_other->share : 0, part.share};
    };
    Part* most = nullptr;
    for (Part& part : last_.parts)
      if (part.response->name == name && (most == nullptr || weight(part) > weight(*most))) most = &part;
    if (most != nullptr) raise(*most, most->share + more / goal_->asked(name));
  }
}

BarParts Forecast::raised() const {
  BarParts raised;
  for (const Part& part : last_.parts)
    if (part.raised) raised[std::string(part.response->name)][part.source] = 0;
  for (const Part& part : last_.parts) {
    const std::string name(part.response->name);
    if (const auto of = raised.find(name); of != raised.end())
      if (const auto source = of->second.find(part.source); source != of->second.end())
        source->second += part.share * goal_->asked(name);
  }
  return raised;
}

void Forecast::take_orders(const Forecast& later) {
  for (Part& part : last_.parts)
    for (const Part& known : later.last_.parts)
      if (part.response == known.response && part.source == known.source && part.knob == known.knob)
        part.order = known.order;
}

std::vector<std::string> Forecast::not_held() const {
  std::vector<std::string> names;
  for (const std::string& name : goal_->responses)
    if (std::ranges::none_of(last_.parts, [&](const Part& part) { return part.response->name == name; }) &&
        std::ranges::find(unresolved_, name, &Response::name) == unresolved_.end())
      names.push_back(name);
  return names;
}

double Forecast::excess(const Settings& there) const {
  double largest = 0, sum = 0;
  const Response* of = nullptr;
  for (const Part& part : last_.parts) {
    if (part.response != of) sum = 0;
    of = part.response;
    sum += part.share * std::pow(finer(part.knob, there, last_.at), -part.order);
    largest = std::max(largest, sum);
  }
  return largest;
}

std::optional<Dominant> Forecast::dominant() const {
  if (!resolves()) {
    const std::string name(unresolved_.front()->name);
    return Dominant{
        .response = name, .source = "mesh", .relative = kInfinity, .whole = kInfinity, .asked = goal_->asked(name)};
  }
  std::map<const Response*, double> sums;
  for (const Part& part : last_.parts) sums[part.response] += part.share;
  const auto worst = std::ranges::max_element(sums, {}, [](const auto& s) { return s.second; });
  if (worst == sums.end()) return {};
  Dominant result{.response = std::string(worst->first->name)};
  std::map<std::string, double> by_source;
  for (const Part& part : last_.parts)
    if (part.response == worst->first) by_source[part.source] += part.share;
  const auto largest = std::ranges::max_element(by_source, {}, [](const auto& s) { return s.second; });
  if (largest->second > 0) result.source = largest->first;
  result.asked = goal_->asked(result.response);
  result.relative = worst->second * result.asked;
  result.whole = whole_.at(result.response);
  return result;
}

double Forecast::operations(const Settings& there) const {
  const double mesh = finer(Knob::mesh, there, last_.at), beside = finer(Knob::beside, there, last_.at);
  const double dofs =
      dofs_ * (in_space_ ? std::pow(mesh, kForecast.dofs_in_space)
                         : std::pow(mesh, kForecast.dofs_along) * std::pow(beside, kForecast.dofs_beside));
  const double matrices = (in_space_ ? kForecast.matrices_by_in_space : kForecast.matrices_by) *
                          std::pow(dofs, in_space_ ? kForecast.matrices_in_space : kForecast.matrices_in_plane) *
                          std::pow(there.modes / kForecast.modes, kForecast.modes_power);
  const double nodes = std::pow(mesh, in_space_ ? kForecast.nodes_in_space : kForecast.nodes_in_plane);
  return matrices + contact_ * states_by(there) / states_by(last_.at) * std::pow(nodes, kForecast.contact_by_nodes) *
                        std::pow(finer(Knob::harmonics, there, last_.at), kForecast.contact_by_harmonics) *
                        std::pow(finer(Knob::samples, there, last_.at), kForecast.contact_by_samples);
}

/// A response without a value has no accuracy, one without a limit none that could be bought. One that is asked of
/// and that the mesh does not resolve has none there.
void Forecast::add(const Response& response, const Evaluation& evaluation, std::optional<double> beside) {
  const std::string name(response.name);
  const auto value = evaluation.responses.find(name);
  const auto bars = evaluation.error_sources.find(name);
  if (value == evaluation.responses.end() || value->second == 0 || bars == evaluation.error_sources.end()) return;
  if (std::ranges::find(evaluation.unbounded, name) != evaluation.unbounded.end()) {
    if (goal_->resolves && !goal_->responses.empty() && response.largest_bar && response.has_limit(*scene_))
      unresolved_.push_back(&response);
    return;
  }
  double whole = 0;
  for (const auto& [source, bar] : bars->second)
    if (source != "history" || !evaluation.left_to_history()) whole += bar;
  whole_[name] = whole / std::abs(value->second);
  known_[name] = {.value = value->second, .bar = whole};
  for (const auto& [source, bar] : bars->second) {
    const Knob knob = knob_of(source);
    if (!counts(knob, *goal_)) continue;
    constexpr double kLeast = kForecast.least_share;
    const double there = source == "mesh" && beside ? std::clamp(*beside, kLeast * bar, (1 - kLeast) * bar) : 0;
    for (const auto& [of, size] : {std::pair{knob, bar - there}, {Knob::beside, there}})
      if (of == knob || size > 0)
        last_.parts.push_back({.response = &response,
                               .source = source,
                               .knob = of,
                               .order = order(response, source, of),
                               .share = size / std::abs(value->second) / goal_->asked(name)});
  }
}

double Forecast::order(const Response& response, const std::string& source, Knob knob) const {
  switch (knob) {
    case Knob::mesh:
    case Knob::beside:
      if (source == "contact_grid") return response.grid_order;
      if (source == "zone_ends") return 1;  // a part of a node
      return in_space_ ? response.mesh_order.in_space : response.mesh_order.in_plane;
    case Knob::harmonics:
      return kForecast.by_harmonics;
    case Knob::samples:
      return kForecast.by_samples;
    case Knob::modes:
      return kForecast.by_modes;
    case Knob::resonance:
      return 1;
    case Knob::none:
      break;
  }
  return 0;
}

}  // namespace dovetail::optimizer
