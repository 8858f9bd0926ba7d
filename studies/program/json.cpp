#include "studies/program/json.hpp"

#include <numbers>

#include "studies/program/json_values.hpp"

namespace dovetail::studies {
namespace {

Json wear_json(const std::string& method, const std::string& status, const WearQuestion& question) {
  Json json;
  json["method"] = method;
  json["status"] = status;
  json["follow"] = question.follow;
  json["frequency_hz"] = number(question.frequency_hz);
  Json& settings = json["settings"];
  settings["harmonics"] = question.settings.harmonics;
  settings["samples"] = question.settings.samples;
  settings["tolerance"] = number(question.settings.tolerance);
  settings["solver"] = question.settings.solver;
  if (question.automatic)
    settings["automatic"] = Json{{"status", std::string(to_string(question.automatic->status))},
                                 {"accuracy", number(question.automatic->accuracy)}};
  if (question.bars)
    json["error_bars"] = Json{{"worn_volume_m3", number(question.bars->worn_volume)},
                              {"largest_depth_m", number(question.bars->largest_depth)}};
  return json;
}

}  // namespace

std::string evaluation_json(const optimizer::Evaluation& evaluation) {
  Json json;
  json["status"] = evaluation.status;
  json["feasible"] = evaluation.feasible;
  json["parameters"] = numbers(evaluation.parameters);
  json["responses"] = numbers(evaluation.responses);
  json["constraints"] = numbers(evaluation.constraints);
  json["error_estimates"] = numbers(evaluation.error_estimates);
  json["model"] = numbers(evaluation.model);
  json["timings_s"] = numbers(evaluation.timings_s);
  json["messages"] = evaluation.messages;
  if (!evaluation.derivatives.empty()) {
    json["derivatives"] = Json::object();
    for (const auto& [name, gradient] : evaluation.derivatives) json["derivatives"][name] = numbers(gradient);
  }
  return text(json);
}

std::string wear_status(const wear::History& history) {
  switch (history.end) {
    case wear::HistoryEnd::worn_out:
      return "asymptote";
    case wear::HistoryEnd::cycles:
      return "no_asymptote";
    default:
      return "not_converged";
  }
}

std::string history_json(const WearQuestion& question, const wear::History& history) {
  const Eigen::Index last = history.depth.rows() - 1;
  Json json = wear_json("history", wear_status(history), question);
  std::vector<double> hz;
  for (const double omega : history.frequency)
    hz.push_back(question.follow == "fixed" ? question.frequency_hz : omega / (2 * std::numbers::pi));
  json["frequencies_hz"] = numbers(hz);
  json["ended"] = std::string(wear::to_string(history.end));
  json["cycles"] = numbers(history.cycles);
  json["worn_volume_m3"] = numbers(history.worn_volume);
  json["depth_m"] = last < 0 ? Json::array() : numbers(Eigen::VectorXd(history.depth.row(last).transpose()));
  json["final_wear_rate_m_per_cycle"] =
      last < 0 ? Json::array() : numbers(Eigen::VectorXd(history.rate.row(last).transpose()));
  json["solves"] = history.solves;
  return text(json);
}

std::string asymptote_json(const WearQuestion& question, const wear::Asymptote& asymptote,
                           const std::vector<double>& frequencies_hz, int solves) {
  Json json = wear_json("asymptote", std::string(wear::to_string(asymptote.verdict)), question);
  json["frequencies_hz"] = numbers(frequencies_hz);
  json["cycles"] = Json::array({nullptr});
  json["worn_volume_m3"] = Json::array({number(asymptote.worn_volume)});
  json["interpolated_volume_m3"] = number(asymptote.interpolated_volume);
  json["volume_bracket_m3"] = Json::array({number(asymptote.volume_bracket[0]), number(asymptote.volume_bracket[1])});
  json["depth_m"] = numbers(asymptote.depth);
  json["final_wear_rate_m_per_cycle"] = numbers(asymptote.rate);
  json["solves"] = solves;
  return text(json);
}

}  // namespace dovetail::studies
