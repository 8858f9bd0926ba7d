#include "studies/program/answers/version.hpp"
#include "studies/program/engine/json_values.hpp"
#include "studies/program/engine/number_constants.hpp"
#include "studies/program/engine/response_curve.hpp"

namespace dovetail::studies {
namespace {

using quality::Quantities;

/// Of coefficients [c0, c1, s1, ...] the cosines h = 0..H, or with `sine` the sines, of which that of h = 0 is 0.
Json series(const Eigen::RowVectorXd& coefficients, bool sine) {
  const double mean = coefficients[0];
  Eigen::VectorXd values =
      Eigen::VectorXd::Constant((coefficients.size() + 1) / 2, sine && std::isfinite(mean) ? 0 : mean);
  for (Eigen::Index h = 1; h < values.size(); ++h) values[h] = coefficients[sine ? 2 * h : 2 * h - 1];
  return json_of(values);
}

/// "outputs":{NAME:list} and lists of the other quantities: `entry(point, get)` is the entry of a point for the
/// quantity that `get` reads from Quantities.
template <class Entry>
Json quantity_lists(const ResponseCurve& curve, const Entry& entry) {
  Json json;
  const auto list = [&](const auto& get) {
    Json entries = Json::array();
    for (const PointAnalysis& point : curve.analyses) entries.push_back(entry(point, get));
    return entries;
  };
  json["outputs"] = Json::object();
  for (std::size_t i = 0; i < curve.output_names.size(); ++i)
    json["outputs"][curve.output_names[i]] =
        list([i](const Quantities& q) { return q.amplitudes(static_cast<Eigen::Index>(i)); });
  json["dissipated_energy_j"] = list(std::mem_fn(&Quantities::friction_energy));
  json["largest_wear_rate_m_per_cycle"] = list(std::mem_fn(&Quantities::largest_wear_rate));
  json["wear_volume_rate_m3_per_cycle"] = list(std::mem_fn(&Quantities::wear_volume_rate));
  return json;
}

/// A column with an entry for each point that has the analysis, and null for the others.
template <class Analysis, class Get>
auto column_of(const char* key, std::optional<Analysis> PointAnalysis::*analysis, Get get) {
  return Column(key, [=](const PointAnalysis& point) {
    return point.*analysis ? json_of(std::invoke(get, *(point.*analysis))) : Json(nullptr);
  });
}

Json error_bars_json(const ResponseCurve& curve) {
  using quality::ErrorBars;
  Json json;
  add_columns(json, curve.analyses, column_of("status", &PointAnalysis::bars, &ErrorBars::status));
  const auto add = [&](const char* name, Quantities ErrorBars::*part) {
    json[name] = quantity_lists(curve, [&](const PointAnalysis& point, const auto& get) {
      return point.bars ? json_of(get((*point.bars).*part)) : Json(nullptr);
    });
  };
  add("total", &ErrorBars::total);
  add("harmonics", &ErrorBars::harmonics);
  add("samples", &ErrorBars::samples);
  add("penalty", &ErrorBars::penalty);
  return json;
}

Json sensitivity_json(const ResponseCurve& curve) {
  Json json;
  json["ratios"] = Json::array();
  for (const PointAnalysis& point : curve.analyses)
    if (point.sensitivity) json["ratios"] = json_of(point.sensitivity->ratios);
  add_columns(json, curve.analyses,
              column_of("status", &PointAnalysis::sensitivity, &quality::PenaltySensitivity::statuses));
  json["values"] = quantity_lists(curve, [](const PointAnalysis& point, const auto& get) {
    if (!point.sensitivity) return Json(nullptr);
    Json list = Json::array();
    for (const Quantities& value : point.sensitivity->values) list.push_back(json_of(get(value)));
    return list;
  });
  json["slope"] = quantity_lists(curve, [](const PointAnalysis& point, const auto& get) {
    return point.sensitivity ? json_of(get(point.sensitivity->slope)) : Json(nullptr);
  });
  return json;
}

Json stability_json(const ResponseCurve& curve) {
  using stability::Stability, stability::StabilityVerdict;
  const auto column = [](const char* key, auto get) { return column_of(key, &PointAnalysis::stability, get); };
  const auto filled = [](const Stability& found) {
    return found.verdict != StabilityVerdict::not_meaningful && found.verdict != StabilityVerdict::undetermined;
  };
  const auto known = [&](double Stability::*value) {
    return [=](const Stability& found) { return filled(found) ? found.*value : kUnknown; };
  };
  Json json;
  add_columns(
      json, curve.analyses, column("verdict", &Stability::verdict), column("reason", &Stability::reason),
      column("largest_modulus", known(&Stability::largest_modulus)), column("error", known(&Stability::error)),
      column("multipliers",
             [&](const Stability& found) { return filled(found) ? json_of(found.multipliers) : Json::array(); }),
      column("neutral", &Stability::neutral), column("events", &Stability::events));
  return json;
}

/// Lists minimum, maximum, status, reason, over the points, of the bounds that `get` reads.
template <class Get>
Json bounds_json(const ResponseCurve& curve, const Get& get) {
  using tractions::TractionBounds;
  const auto column = [&](const char* key, auto value) {
    return column_of(key, &PointAnalysis::tractions,
                     [=](const TractionRanges& ranges) { return std::invoke(value, std::invoke(get, ranges)); });
  };
  const auto known = [](auto TractionBounds::*end) {
    return [=](const TractionBounds& bounds) {
      const bool there = bounds.status == Status::converged || bounds.status == Status::iteration_limit;
      return there ? (bounds.*end).value : kUnknown;
    };
  };
  Json json;
  add_columns(json, curve.analyses, column("minimum", known(&TractionBounds::minimum)),
              column("maximum", known(&TractionBounds::maximum)), column("status", &TractionBounds::status),
              column("reason", &TractionBounds::reason), column("stuck_nodes", &TractionBounds::stuck_nodes));
  return json;
}

Json traction_bounds_json(const ResponseCurve& curve) {
  Json json;
  json["outputs"] = Json::object();
  for (std::size_t i = 0; i < curve.output_names.size(); ++i)
    json["outputs"][curve.output_names[i]] =
        bounds_json(curve, [i](const TractionRanges& ranges) { return ranges.amplitudes[i]; });
  json["dissipated_energy_j"] = bounds_json(curve, &TractionRanges::friction_energy);
  json["wear_volume_rate_m3_per_cycle"] = bounds_json(curve, &TractionRanges::wear_rate);
  return json;
}

Json settings_json(const ResponseCurve& curve) {
  Json json = json_of(curve.settings);
  json["pseudo_penalty_n_per_m"] =
      Json{{"normal", json_of(curve.penalty.normal)}, {"tangential", json_of(curve.penalty.tangential)}};
  if (curve.automatic) json["automatic"] = Json{{"status", json_of(*curve.automatic)}, {"accuracy", curve.accuracy}};
  return json;
}

Json branch_json(const branches::Branch& branch) {
  using branches::BranchPoint;
  Json json{{"status", json_of(branch.status)},
            {"turns", branch.turns()},
            {"jacobians", branch.jacobians},
            {"rejected", branch.rejected}};
  add_columns(json, branch.points, Column("arc_length", &BranchPoint::arc_length),
              Column("direction", &BranchPoint::direction), Column("is_turn", &BranchPoint::is_turn));
  return json;
}

/// At a point that did not converge what it would have is not known.
Json output_json(const ResponseCurve& curve, Eigen::Index output) {
  using steady::State;
  const Eigen::Index columns = 2 * curve.settings.harmonics + 1;
  const auto coefficients = [=](const State& state) -> Eigen::RowVectorXd {
    if (state.status != Status::converged) return Eigen::RowVectorXd::Constant(columns, kUnknown);
    return output < state.outputs.rows() ? Eigen::RowVectorXd(state.outputs.row(output))
                                         : Eigen::RowVectorXd::Zero(columns);
  };
  const auto amplitude = [=](const State& state) {
    return state.status == Status::converged && output < state.outputs.rows() ? state.amplitudes[output] : kUnknown;
  };
  Json json;
  add_columns(json, curve.states, Column("amplitude", amplitude),
              Column("cosine", [=](const State& state) { return series(coefficients(state), false); }),
              Column("sine", [=](const State& state) { return series(coefficients(state), true); }));
  return json;
}

}  // namespace

std::string response_json(const ResponseCurve& curve) {
  using steady::State;
  const auto known = [](double State::*value) {
    return [=](const State& state) { return state.status == Status::converged ? state.*value : kUnknown; };
  };
  const auto wear_rate = [&](const State& state) -> Eigen::VectorXd {
    if (state.status == Status::converged) return state.wear_rate;
    return Eigen::VectorXd::Constant(std::max(curve.penalty.normal.size(), state.wear_rate.size()), kUnknown);
  };
  Json json{{"version", kAnswerVersion}};
  const auto points = static_cast<std::ptrdiff_t>(curve.states.size());  // fewer than asked for when interrupted
  json["frequency_hz"] = json_of(std::vector(curve.frequency_hz.begin(), curve.frequency_hz.begin() + points));
  add_columns(json, curve.states, Column("status", &State::status), Column("iterations", &State::iterations));
  json["outputs"] = Json::object();
  for (std::size_t i = 0; i < curve.output_names.size(); ++i)
    json["outputs"][curve.output_names[i]] = output_json(curve, static_cast<Eigen::Index>(i));
  add_columns(json, curve.states, Column("dissipated_energy_j", known(&State::friction_energy)),
              Column("error_force", known(&State::error_force)), Column("error_energy", known(&State::error_energy)),
              Column("wear_rate_m_per_cycle", wear_rate),
              // A state that was never reached has no residual.
              Column("residual", [](const State& state) { return state.evaluations > 0 ? state.residual : kUnknown; }),
              Column("penalty_ratio", known(&State::penalty_ratio)));
  json["settings"] = settings_json(curve);
  if (curve.branch) json["arclength"] = branch_json(*curve.branch);
  if (curve.choice.error_bars) json["error_bars"] = error_bars_json(curve);
  if (curve.choice.penalty_sensitivity) json["penalty_sensitivity"] = sensitivity_json(curve);
  if (curve.choice.stability) json["stability"] = stability_json(curve);
  if (curve.choice.traction_bounds) json["traction_bounds"] = traction_bounds_json(curve);
  return text(json);
}

}  // namespace dovetail::studies
