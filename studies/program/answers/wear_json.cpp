// The answer of the command wear as JSON.
#include "studies/program/answers/json.hpp"
#include "studies/program/answers/version.hpp"
#include "studies/program/engine/json_values.hpp"
#include "studies/program/engine/number_constants.hpp"
#include "studies/program/engine/wear_methods.hpp"

namespace dovetail::optimizer {

template <>
inline constexpr auto kFields<studies::WornCurve> = std::tuple{
    RecordField{"cycles", &studies::WornCurve::cycles}, RecordField{"worn_volume_m3", &studies::WornCurve::worn_volume},
    RecordField{"frequency_hz", &studies::WornCurve::frequency_hz},
    RecordField{"amplitude_m", &studies::WornCurve::amplitude}};

template <>
inline constexpr auto kFields<wear::OtherState> = std::tuple{
    RecordField{"found_by", &wear::OtherState::found_by}, RecordField{"worn_volume_m3", &wear::OtherState::worn_volume},
    RecordField{"largest_depth_m", &wear::OtherState::largest_depth}, RecordField{"depth_m", &wear::OtherState::depth}};

}  // namespace dovetail::optimizer

namespace dovetail::studies {
namespace {

Json worn(double volume, double depth) {
  return Json{{"worn_volume_m3", json_of(volume)}, {"largest_depth_m", json_of(depth)}};
}

/// "spread": {SOURCE: {"status", "nominal", "low", "high", "profile_change", "members"}}.
Json spread_json(const wear::Spread& spread) {
  Json json = Json::object();
  for (const wear::SpreadRange& range : spread.ranges) {
    Json& source = json[range.source];
    source["status"] = json_of(range.verdict);
    source["nominal"] = worn(spread.nominal.volume, spread.nominal.largest_depth());
    source["low"] = worn(range.lowest_volume, range.lowest_depth);
    source["high"] = worn(range.highest_volume, range.highest_depth);
    source["profile_change"] = json_of(range.profile_change);
    source["members"] = Json::array();
    for (const wear::SpreadMember& member : spread.members) {
      if (member.source != range.source) continue;
      const wear::WornEnd& end = member.end;
      Json entry{{"change", member.change}, {"status", json_of(end.verdict)}};
      if (end.verdict == wear::Verdict::not_converged) entry["reason"] = json_of(end.status);
      const bool known = end.verdict == wear::Verdict::asymptote;
      entry.update(known ? worn(end.volume, end.largest_depth()) : worn(kUnknown, kUnknown));
      source["members"].push_back(std::move(entry));
    }
  }
  return json;
}

Json band_json(const WearBand& band) {
  const double worst = band.frequencies_hz.empty() ? kUnknown : band.frequencies_hz[band.worst];
  return Json{{"frequency_hz", json_of(band.frequencies_hz)}, {"status", json_of(band.status)},
              {"worn_volume_m3", json_of(band.volume)},       {"largest_depth_m", json_of(band.largest_depth)},
              {"worst_frequency_hz", json_of(worst)},         {"envelope_depth_m", json_of(band.envelope)}};
}

Json choice_json(const HistoryChoice& choice) {
  const wear::HistoryOptions& options = choice.options;
  Json json{
      {"integrator", json_of(options.integrator)}, {"tolerance", json_of(options.tolerance)}, {"steps", options.steps}};
  if (options.integrator == wear::IntegratorKind::explicit_jumps) json["increment_m"] = json_of(options.increment);
  if (choice.depth_scale > 0) json["depth_scale_m"] = json_of(choice.depth_scale);
  json["cycles"] = json_of(options.cycles > 0 ? options.cycles : kUnknown);
  json["start_cycles"] = json_of(choice.start_cycles);
  json["rate_threshold_m_per_cycle"] = json_of(options.rate_threshold < 0 ? kUnknown : options.rate_threshold);
  if (!choice.resumed_from.empty()) json["resumed_from"] = choice.resumed_from;
  if (!choice.identity.empty()) json["identity"] = Json::object();
  for (const IdentityEntry& entry : choice.identity)
    std::visit([&](const auto& value) { json["identity"][entry.key] = value; }, entry.value);
  return json;
}

Json unknown(Eigen::Index size) {
  return Json(static_cast<std::size_t>(size), Json(nullptr));
}

/// The finished state, after any number of cycles, is the last entry of the lists.
void add_history(const wear::History& history, Json& json) {
  const bool known = history.cycles.size() > 0;
  json["ended"] = json_of(history.end);
  json["cycles"] = json_of(history.cycles);
  json["worn_volume_m3"] = json_of(history.worn_volume);
  json["depth_m"] = known ? json_of(history.final_depth) : unknown(history.final_depth.size());
  json["final_worn_volume_m3"] = json_of(known ? history.final_volume : kUnknown);
  json["finished"] = history.finished;
  json["amplitude_m"] = json_of(history.amplitude);
  json["depths_m"] = json_of(history.depth);
  json["wear_rates_m_per_cycle"] = json_of(history.rate);
  json["final_wear_rate_m_per_cycle"] = known ? json_of(history.final_rate) : unknown(history.final_depth.size());
  json["other_states"] = Json::array();
  if (!known || !history.finished) return;
  json["cycles"].push_back(nullptr);
  json["worn_volume_m3"].push_back(json_of(history.final_volume));
  json["amplitude_m"].push_back(nullptr);
  json["depths_m"].push_back(json["depth_m"]);
  json["wear_rates_m_per_cycle"].push_back(json["final_wear_rate_m_per_cycle"]);
  if (!json["frequencies_hz"].empty()) json["frequencies_hz"].push_back(json["frequencies_hz"].back());
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
  json["worn_volume_m3"] = rests ? Json::array({json_of(asymptote.worn_volume)}) : unknown(1);
  json["depth_m"] = rests ? json_of(asymptote.depth) : unknown(asymptote.depth.size());
  json["final_wear_rate_m_per_cycle"] = json_of(asymptote.rate);
  json["certificate"] = json_of(asymptote.certificate);
  if (asymptote.finer.harmonics > 0)
    json["finer_certificate"] = Json{{"harmonics", asymptote.finer.harmonics},
                                     {"samples", asymptote.finer.samples},
                                     {"status", json_of(asymptote.finer.status)},
                                     {"remaining", json_of(asymptote.finer.remaining)},
                                     {"holds", asymptote.holds_finer}};
}

void add_verdict(const wear::Asymptote& asymptote, Json& json) {
  if (asymptote.verdict != wear::Verdict::not_converged) json["decided_by"] = json_of(asymptote.decided_by);
  json["doubt"] = json_of(asymptote.doubt);
  json["confirmed_by_history"] = asymptote.confirmed_by_history;
  json["other_states"] = json_of(asymptote.other_states);  // at rest, but did not decide
}

}  // namespace

std::string wear_json(const WearQuestion& question, const WearAnswer& answer) {
  Json json{{"version", kAnswerVersion}};
  json["method"] = json_of(answer.history ? WearMethod::history : WearMethod::asymptote);
  json["status"] = json_of(answer.status);
  if (answer.status == wear::Verdict::not_converged)
    json["reason"] = json_of(answer.reason.empty() ? std::string(to_string(answer.solver)) : answer.reason);
  json["follow"] = json_of(question.follow);
  json["frequency_hz"] = json_of(question.frequency_hz);
  json["frequencies_hz"] = json_of(answer.frequencies_hz);
  if (answer.history) {
    add_history(*answer.history, json);
    json["history"] = choice_json(answer.choice);
    json["history"]["memory"] = json_of(answer.history->memory);
    json["history"]["memory"]["displacement_m"] = json_of(answer.history->steady.displacement);
    if (!answer.curves.empty()) json["response_curves"] = json_of(answer.curves);
  }
  if (answer.asymptote) {
    add_asymptote(*answer.asymptote, json);
    add_verdict(*answer.asymptote, json);
  }
  json["solves"] = answer.solves;
  json["settings"] = json_of(question.settings);
  if (question.automatic)
    json["settings"]["automatic"] =
        Json{{"status", json_of(question.automatic->status)}, {"accuracy", json_of(question.automatic->accuracy)}};
  if (question.bars) json["error_bars"] = worn(question.bars->worn_volume, question.bars->largest_depth);
  if (question.spread) json["spread"] = spread_json(*question.spread);
  if (question.band) json["band"] = band_json(*question.band);
  return text(json);
}

}  // namespace dovetail::studies
