#include <utility>

#include "studies/program/json_values.hpp"
#include "studies/program/response_curve.hpp"

namespace dovetail::studies {
namespace {

using quality::Quantities;

/// cosine[h] and sine[h], h = 0..H, of coefficients [c0, c1, s1, ...]; NaN when the point did not converge.
std::pair<Eigen::VectorXd, Eigen::VectorXd> cosine_and_sine(const Eigen::RowVectorXd& coefficients, bool valid) {
  const Eigen::Index harmonics = (coefficients.size() - 1) / 2;
  Eigen::VectorXd cosine = Eigen::VectorXd::Constant(harmonics + 1, std::nan(""));
  Eigen::VectorXd sine = cosine;
  if (!valid) return {cosine, sine};
  cosine[0] = coefficients[0];
  sine[0] = 0;
  for (Eigen::Index h = 1; h <= harmonics; ++h) {
    cosine[h] = coefficients[2 * h - 1];
    sine[h] = coefficients[2 * h];
  }
  return {cosine, sine};
}

/// "outputs":{NAME:list} and the other quantities, with one entry in each list for every point.
class QuantityLists {
 public:
  explicit QuantityLists(const std::vector<std::string>& outputs) : outputs_(outputs) {
    json_["outputs"] = Json::object();
    for (const std::string& name : outputs_) json_["outputs"][name] = Json::array();
    for (const char* key : kKeys) json_[key] = Json::array();
  }
  /// `entry(get)` is the point's entry for the quantity that `get` reads from Quantities.
  template <class Entry>
  void add(const Entry& entry) {
    for (std::size_t i = 0; i < outputs_.size(); ++i)
      json_["outputs"][outputs_[i]].push_back(
          entry([i](const Quantities& q) { return q.amplitudes(static_cast<Eigen::Index>(i)); }));
    json_[kKeys[0]].push_back(entry([](const Quantities& q) { return q.friction_energy; }));
    json_[kKeys[1]].push_back(entry([](const Quantities& q) { return q.largest_wear_rate; }));
    json_[kKeys[2]].push_back(entry([](const Quantities& q) { return q.wear_volume_rate; }));
  }
  void add_nothing() {
    add([](const auto&) { return Json(nullptr); });
  }
  [[nodiscard]] const Json& json() const { return json_; }

 private:
  static constexpr std::array<const char*, 3> kKeys{"dissipated_energy_j", "largest_wear_rate_m_per_cycle",
                                                    "wear_volume_rate_m3_per_cycle"};
  const std::vector<std::string>& outputs_;
  Json json_;
};

Json error_bars_json(const ResponseCurve& curve) {
  Json json;
  json["status"] = Json::array();
  const std::array<std::pair<const char*, Quantities quality::ErrorBars::*>, 4> parts{
      {{"total", &quality::ErrorBars::total},
       {"harmonics", &quality::ErrorBars::harmonics},
       {"samples", &quality::ErrorBars::samples},
       {"penalty", &quality::ErrorBars::penalty}}};
  for (const PointAnalysis& point : curve.analyses)
    json["status"].push_back(point.bars ? Json(std::string(to_string(point.bars->status))) : Json(nullptr));
  for (const auto& [name, member] : parts) {
    QuantityLists lists(curve.output_names);
    for (const PointAnalysis& point : curve.analyses)
      if (point.bars)
        lists.add([&, part = member](const auto& get) { return number(get((*point.bars).*part)); });
      else
        lists.add_nothing();
    json[name] = lists.json();
  }
  return json;
}

Json sensitivity_json(const ResponseCurve& curve) {
  Json json;
  json["ratios"] = Json::array();
  json["status"] = Json::array();
  QuantityLists values(curve.output_names), slopes(curve.output_names);
  for (const PointAnalysis& point : curve.analyses) {
    if (!point.sensitivity) {
      json["status"].push_back(nullptr);
      values.add_nothing();
      slopes.add_nothing();
      continue;
    }
    const quality::PenaltySensitivity& found = *point.sensitivity;
    json["ratios"] = numbers(found.ratios);
    Json statuses = Json::array();
    for (const Status status : found.statuses) statuses.push_back(std::string(to_string(status)));
    json["status"].push_back(statuses);
    values.add([&](const auto& get) {
      Json list = Json::array();
      for (const Quantities& value : found.values) list.push_back(number(get(value)));
      return list;
    });
    slopes.add([&](const auto& get) { return number(get(found.slope)); });
  }
  json["values"] = values.json();
  json["slope"] = slopes.json();
  return json;
}

Json stability_json(const ResponseCurve& curve) {
  Json json;
  for (const char* key : {"verdict", "reason", "largest_modulus", "error", "multipliers", "neutral", "events"})
    json[key] = Json::array();
  for (const PointAnalysis& point : curve.analyses) {
    if (!point.stability) {
      for (auto& list : json) list.push_back(nullptr);
      continue;
    }
    const stability::Stability& found = *point.stability;
    const bool filled = found.verdict != stability::StabilityVerdict::not_meaningful &&
                        found.verdict != stability::StabilityVerdict::undetermined;
    json["verdict"].push_back(std::string(to_string(found.verdict)));
    json["reason"].push_back(found.reason);
    json["largest_modulus"].push_back(filled ? number(found.largest_modulus) : Json(nullptr));
    json["error"].push_back(filled ? number(found.error) : Json(nullptr));
    Json multipliers = Json::array();
    if (filled)
      for (const std::complex<double>& m : found.multipliers)
        multipliers.push_back(Json::array({number(m.real()), number(m.imag())}));
    json["multipliers"].push_back(multipliers);
    json["neutral"].push_back(found.neutral);
    json["events"].push_back(found.events);
  }
  return json;
}

/// Lists minimum, maximum, status, reason, over the points, of the bounds that `get` reads.
template <class Get>
Json bounds_json(const ResponseCurve& curve, const Get& get) {
  Json json;
  for (const char* key : {"minimum", "maximum", "status", "reason", "stuck_nodes"}) json[key] = Json::array();
  for (const PointAnalysis& point : curve.analyses) {
    if (!point.tractions) {
      for (auto& list : json) list.push_back(nullptr);
      continue;
    }
    const tractions::TractionBounds& bounds = get(*point.tractions);
    const bool known = bounds.status == Status::converged || bounds.status == Status::iteration_limit;
    json["minimum"].push_back(known ? number(bounds.minimum.value) : Json(nullptr));
    json["maximum"].push_back(known ? number(bounds.maximum.value) : Json(nullptr));
    json["status"].push_back(std::string(to_string(bounds.status)));
    json["reason"].push_back(bounds.reason);
    json["stuck_nodes"].push_back(bounds.stuck_nodes);
  }
  return json;
}

Json traction_bounds_json(const ResponseCurve& curve) {
  Json json;
  json["outputs"] = Json::object();
  for (std::size_t i = 0; i < curve.output_names.size(); ++i)
    json["outputs"][curve.output_names[i]] = bounds_json(
        curve, [i](const TractionRanges& ranges) -> const auto& { return ranges.amplitudes[i]; });
  json["dissipated_energy_j"] = bounds_json(
      curve, [](const TractionRanges& ranges) -> const auto& { return ranges.friction_energy; });
  json["wear_volume_rate_m3_per_cycle"] = bounds_json(
      curve, [](const TractionRanges& ranges) -> const auto& { return ranges.wear_rate; });
  return json;
}

Json settings_json(const ResponseCurve& curve) {
  Json json;
  json["harmonics"] = curve.settings.harmonics;
  json["samples"] = curve.settings.samples;
  json["tolerance"] = number(curve.settings.tolerance);
  json["solver"] = curve.settings.solver;
  json["pseudo_penalty_n_per_m"] =
      Json{{"normal", numbers(curve.penalty.normal)}, {"tangential", numbers(curve.penalty.tangential)}};
  if (curve.automatic)
    json["automatic"] = Json{{"status", std::string(to_string(*curve.automatic))}, {"accuracy", curve.accuracy}};
  return json;
}

Json branch_json(const branches::Branch& branch) {
  Json json;
  json["status"] = std::string(to_string(branch.status));
  json["turns"] = branch.turns();
  json["jacobians"] = branch.jacobians;
  json["rejected"] = branch.rejected;
  for (const char* key : {"arc_length", "direction", "is_turn"}) json[key] = Json::array();
  for (const branches::BranchPoint& point : branch.points) {
    json["arc_length"].push_back(number(point.arc_length));
    json["direction"].push_back(number(point.direction));
    json["is_turn"].push_back(point.is_turn);
  }
  return json;
}

}  // namespace

std::string response_json(const ResponseCurve& curve) {
  Json json;
  for (const char* key : {"frequency_hz", "status", "iterations"}) json[key] = Json::array();
  json["outputs"] = Json::object();
  for (const std::string& name : curve.output_names)
    json["outputs"][name] = Json{{"amplitude", Json::array()}, {"cosine", Json::array()}, {"sine", Json::array()}};
  for (const char* key :
       {"dissipated_energy_j", "error_force", "error_energy", "wear_rate_m_per_cycle", "residual", "penalty_ratio"})
    json[key] = Json::array();
  const Eigen::Index columns = 2 * curve.settings.harmonics + 1;
  for (std::size_t point = 0; point < curve.states.size(); ++point) {
    const steady::State& state = curve.states[point];
    const bool valid = state.status == Status::converged;
    const auto known = [&](double value) { return valid ? number(value) : Json(nullptr); };
    json["frequency_hz"].push_back(number(curve.frequency_hz[point]));
    json["status"].push_back(std::string(to_string(state.status)));
    json["iterations"].push_back(state.iterations);
    for (Eigen::Index i = 0; i < static_cast<Eigen::Index>(curve.output_names.size()); ++i) {
      Json& output = json["outputs"][curve.output_names[static_cast<std::size_t>(i)]];
      const bool filled = i < state.outputs.rows();
      Eigen::RowVectorXd coefficients = Eigen::RowVectorXd::Zero(columns);
      if (filled) coefficients = state.outputs.row(i);
      const auto [cosine, sine] = cosine_and_sine(coefficients, valid);
      output["amplitude"].push_back(known(filled ? state.amplitudes[i] : std::nan("")));
      output["cosine"].push_back(numbers(cosine));
      output["sine"].push_back(numbers(sine));
    }
    json["dissipated_energy_j"].push_back(known(state.friction_energy));
    json["error_force"].push_back(known(state.error_force));
    json["error_energy"].push_back(known(state.error_energy));
    const Eigen::Index nodes = std::max(curve.penalty.normal.size(), state.wear_rate.size());
    const Eigen::VectorXd rate = valid ? state.wear_rate : Eigen::VectorXd::Constant(nodes, std::nan(""));
    json["wear_rate_m_per_cycle"].push_back(numbers(rate));
    // A state that was never reached has no residual.
    json["residual"].push_back(state.evaluations > 0 ? number(state.residual) : Json(nullptr));
    json["penalty_ratio"].push_back(known(state.penalty_ratio));
  }
  json["settings"] = settings_json(curve);
  if (curve.branch) json["arclength"] = branch_json(*curve.branch);
  if (curve.choice.error_bars) json["error_bars"] = error_bars_json(curve);
  if (curve.choice.penalty_sensitivity) json["penalty_sensitivity"] = sensitivity_json(curve);
  if (curve.choice.stability) json["stability"] = stability_json(curve);
  if (curve.choice.traction_bounds) json["traction_bounds"] = traction_bounds_json(curve);
  return text(json);
}

}  // namespace dovetail::studies
