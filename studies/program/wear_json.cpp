// The answer of the command wear as JSON.
#include "studies/program/json.hpp"
#include "studies/program/json_values.hpp"
#include "studies/program/wear_methods.hpp"

namespace dovetail::studies {
namespace {

Json question_json(const WearQuestion& question) {
  Json settings;
  settings["harmonics"] = question.settings.harmonics;
  settings["samples"] = question.settings.samples;
  settings["tolerance"] = number(question.settings.tolerance);
  settings["solver"] = question.settings.solver;
  if (question.automatic)
    settings["automatic"] = Json{{"status", std::string(to_string(question.automatic->status))},
                                 {"accuracy", number(question.automatic->accuracy)}};
  return settings;
}

Json worn(double volume, double depth) {
  return Json{{"worn_volume_m3", number(volume)}, {"largest_depth_m", number(depth)}};
}

/// "spread": {SOURCE: {"status", "nominal", "low", "high", "profile_change", "members"}}.
Json spread_json(const wear::Spread& spread) {
  Json json = Json::object();
  for (const wear::SpreadRange& range : spread.ranges) {
    Json& source = json[range.source];
    source["status"] = std::string(wear::to_string(range.verdict));
    source["nominal"] = worn(spread.nominal.volume, spread.nominal.largest_depth());
    source["low"] = worn(range.lowest_volume, range.lowest_depth);
    source["high"] = worn(range.highest_volume, range.highest_depth);
    source["profile_change"] = number(range.profile_change);
    source["members"] = Json::array();
    for (const wear::SpreadMember& member : spread.members) {
      if (member.source != range.source) continue;
      const bool known = member.end.verdict == wear::Verdict::asymptote;
      Json entry{{"change", member.change}, {"status", std::string(wear::to_string(member.end.verdict))}};
      if (member.end.verdict == wear::Verdict::not_converged)
        entry["reason"] = std::string(to_string(member.end.status));
      entry["worn_volume_m3"] = known ? number(member.end.volume) : Json(nullptr);
      entry["largest_depth_m"] = known ? number(member.end.largest_depth()) : Json(nullptr);
      source["members"].push_back(std::move(entry));
    }
  }
  return json;
}

Json band_json(const WearBand& band) {
  Json json;
  json["frequency_hz"] = numbers(band.frequencies_hz);
  json["status"] = band.status;
  json["worn_volume_m3"] = numbers(band.volume);
  json["largest_depth_m"] = numbers(band.largest_depth);
  json["worst_frequency_hz"] = band.frequencies_hz.empty() ? Json(nullptr) : number(band.frequencies_hz[band.worst]);
  json["envelope_depth_m"] = numbers(band.envelope);
  return json;
}

Json rows(const Eigen::MatrixXd& matrix) {
  Json list = Json::array();
  for (Eigen::Index i = 0; i < matrix.rows(); ++i) list.push_back(numbers(Eigen::VectorXd(matrix.row(i).transpose())));
  return list;
}

Json choice_json(const HistoryChoice& choice) {
  const wear::HistoryOptions& options = choice.options;
  Json json{{"integrator", options.integrator}, {"tolerance", number(options.tolerance)}, {"steps", options.steps}};
  if (options.integrator == "explicit") json["increment_m"] = number(options.increment);
  if (choice.depth_scale > 0) json["depth_scale_m"] = number(choice.depth_scale);
  json["cycles"] = options.cycles > 0 ? number(options.cycles) : Json(nullptr);
  json["start_cycles"] = number(choice.start_cycles);
  json["rate_threshold_m_per_cycle"] = options.rate_threshold < 0 ? Json(nullptr) : number(options.rate_threshold);
  if (!choice.resumed_from.empty()) json["resumed_from"] = choice.resumed_from;
  if (!choice.identity.empty()) json["identity"] = Json::object();
  for (const IdentityEntry& entry : choice.identity)
    std::visit([&](const auto& value) { json["identity"][entry.key] = value; }, entry.value);
  return json;
}

/// What --resume needs besides the states.
Json memory_json(const wear::History& history) {
  const wear::StepMemory& memory = history.memory;
  return Json{{"next_step_cycles", number(memory.step)},
              {"penetration_m", number(memory.penetration)},
              {"no_wear_m_per_cycle", number(memory.no_wear)},
              {"finish_below", number(memory.finish_below)},
              {"recovering", memory.recovering},
              {"jumps", memory.jumps},
              {"displacement_m", rows(history.steady.displacement)},
              {"factored_displacement_m", rows(memory.factored_displacement)},
              {"factored_depth_m", numbers(memory.factored_depth)}};
}

Json unknown(Eigen::Index size) {
  return Json(static_cast<std::size_t>(size), Json(nullptr));
}

Json curves_json(const std::vector<WornCurve>& curves) {
  Json list = Json::array();
  for (const WornCurve& curve : curves)
    list.push_back(Json{{"cycles", number(curve.cycles)},
                        {"worn_volume_m3", number(curve.worn_volume)},
                        {"frequency_hz", numbers(curve.frequency_hz)},
                        {"amplitude_m", numbers(curve.amplitude)}});
  return list;
}

/// The finished state, after any number of cycles, is the last entry of the lists.
void add_history(const wear::History& history, Json& json) {
  const bool known = history.cycles.size() > 0;
  json["ended"] = std::string(wear::to_string(history.end));
  json["cycles"] = numbers(history.cycles);
  json["worn_volume_m3"] = numbers(history.worn_volume);
  json["depth_m"] = known ? numbers(history.final_depth) : unknown(history.final_depth.size());
  json["final_worn_volume_m3"] = known ? number(history.final_volume) : Json(nullptr);
  json["finished"] = history.finished;
  json["amplitude_m"] = numbers(history.amplitude);
  json["depths_m"] = rows(history.depth);
  json["wear_rates_m_per_cycle"] = rows(history.rate);
  json["final_wear_rate_m_per_cycle"] = known ? numbers(history.final_rate) : unknown(history.final_depth.size());
  json["other_states"] = Json::array();
  if (!known || !history.finished) return;
  json["cycles"].push_back(nullptr);
  json["worn_volume_m3"].push_back(number(history.final_volume));
  json["amplitude_m"].push_back(nullptr);
  json["depths_m"].push_back(json["depth_m"]);
  json["wear_rates_m_per_cycle"].push_back(json["final_wear_rate_m_per_cycle"]);
  if (!json["frequencies_hz"].empty()) json["frequencies_hz"].push_back(json["frequencies_hz"].back());
}

/// States at rest where the history does not go.
Json other_states(const wear::Asymptote& asymptote) {
  Json list = Json::array();
  for (const wear::OtherState& other : asymptote.other_states)
    list.push_back(Json{{"found_by", std::string(to_string(other.found_by))},
                        {"worn_volume_m3", number(other.worn_volume)},
                        {"largest_depth_m", number(other.largest_depth)},
                        {"depth_m", numbers(other.depth)}});
  return list;
}

/// What an attempt without a verdict knows of the worn state: nothing. Of wear without end the last rates are known.
void add_unknown_asymptote(const wear::Asymptote& asymptote, Json& json) {
  for (const char* key : {"cycles", "worn_volume_m3"}) json[key] = unknown(1);
  for (const char* key : {"depth_m", "final_wear_rate_m_per_cycle"}) json[key] = unknown(asymptote.depth.size());
  for (const char* key : {"certificate", "decided_by"}) json[key] = nullptr;
}

void add_asymptote(const wear::Asymptote& asymptote, Json& json) {
  if (asymptote.verdict == wear::Verdict::not_converged) return add_unknown_asymptote(asymptote, json);
  const bool rests = asymptote.verdict == wear::Verdict::asymptote;
  json["cycles"] = Json::array({nullptr});
  json["worn_volume_m3"] = rests ? Json::array({number(asymptote.worn_volume)}) : unknown(1);
  json["depth_m"] = rests ? numbers(asymptote.depth) : unknown(asymptote.depth.size());
  json["final_wear_rate_m_per_cycle"] = numbers(asymptote.rate);
  json["certificate"] = number(asymptote.certificate);
  if (asymptote.finer.harmonics > 0)
    json["finer_certificate"] = Json{{"harmonics", asymptote.finer.harmonics},
                                     {"samples", asymptote.finer.samples},
                                     {"status", std::string(to_string(asymptote.finer.status))},
                                     {"remaining", number(asymptote.finer.remaining)},
                                     {"holds", asymptote.holds_finer}};
}

void add_verdict(const wear::Asymptote& asymptote, Json& json) {
  if (asymptote.verdict != wear::Verdict::not_converged)
    json["decided_by"] = std::string(to_string(asymptote.decided_by));
  json["doubt"] = std::string(to_string(asymptote.doubt));
  json["confirmed_by_history"] = asymptote.confirmed_by_history;
  json["other_states"] = other_states(asymptote);
}

}  // namespace

std::string wear_status(const wear::History& history) {
  switch (history.end) {
    case wear::HistoryEnd::worn_out:
      return "asymptote";
    case wear::HistoryEnd::steady_rate:
      return "no_asymptote";
    default:
      return "not_converged";
  }
}

std::string wear_json(const WearQuestion& question, const WearAnswer& answer) {
  Json json;
  json["method"] = answer.history ? "history" : "asymptote";
  json["status"] = answer.status;
  if (answer.status == "not_converged")
    json["reason"] = answer.reason.empty() ? std::string(to_string(answer.solver)) : answer.reason;
  json["follow"] = question.follow;
  json["frequency_hz"] = number(question.frequency_hz);
  json["frequencies_hz"] = numbers(answer.frequencies_hz);
  if (answer.history) {
    add_history(*answer.history, json);
    json["history"] = choice_json(answer.choice);
    json["history"]["memory"] = memory_json(*answer.history);
    if (!answer.curves.empty()) json["response_curves"] = curves_json(answer.curves);
  }
  if (answer.asymptote) {
    add_asymptote(*answer.asymptote, json);
    add_verdict(*answer.asymptote, json);
  }
  json["solves"] = answer.solves;
  json["settings"] = question_json(question);
  if (question.bars) json["error_bars"] = worn(question.bars->worn_volume, question.bars->largest_depth);
  if (question.spread) json["spread"] = spread_json(*question.spread);
  if (question.band) json["band"] = band_json(*question.band);
  return text(json);
}

}  // namespace dovetail::studies
