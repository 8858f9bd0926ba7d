#include "studies/program/json.hpp"

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

namespace dovetail::studies {
namespace {

using Json = nlohmann::ordered_json;

Json number(double value) {
  return std::isfinite(value) ? Json(value) : Json(nullptr);
}

Json numbers(const Eigen::Ref<const Eigen::VectorXd>& values) {
  Json list = Json::array();
  for (const double value : values) list.push_back(number(value));
  return list;
}

Json numbers(const std::vector<double>& values) {
  return numbers(Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size())));
}

Json numbers(const std::map<std::string, double>& values) {
  Json object = Json::object();
  for (const auto& [key, value] : values) object[key] = number(value);
  return object;
}

std::string text(const Json& json) {
  return json.dump(1, ' ', false, nlohmann::detail::error_handler_t::replace) + "\n";
}

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

Json wear_json(const std::string& method, const std::string& status, const WearQuestion& question) {
  Json json;
  json["method"] = method;
  json["status"] = status;
  json["follow"] = question.follow;
  json["frequency_hz"] = number(question.frequency_hz);
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

std::string response_json(const std::vector<double>& frequency_hz, const std::vector<response::SteadyState>& states,
                          const std::vector<std::string>& output_names) {
  Json json;
  for (const char* key : {"frequency_hz", "status", "iterations"}) json[key] = Json::array();
  json["outputs"] = Json::object();
  for (const std::string& name : output_names)
    json["outputs"][name] = Json{{"amplitude", Json::array()}, {"cosine", Json::array()}, {"sine", Json::array()}};
  for (const char* key : {"dissipated_energy_j", "error_force", "error_energy", "wear_rate_m_per_cycle"})
    json[key] = Json::array();
  for (std::size_t point = 0; point < states.size(); ++point) {
    const response::SteadyState& state = states[point];
    const bool valid = state.status == Status::converged;
    const auto known = [&](double value) { return valid ? number(value) : Json(nullptr); };
    json["frequency_hz"].push_back(number(frequency_hz[point]));
    json["status"].push_back(std::string(to_string(state.status)));
    json["iterations"].push_back(state.iterations);
    for (Eigen::Index i = 0; i < static_cast<Eigen::Index>(output_names.size()); ++i) {
      Json& output = json["outputs"][output_names[static_cast<std::size_t>(i)]];
      const bool filled = i < state.outputs.rows();
      Eigen::RowVectorXd coefficients = Eigen::RowVectorXd::Zero(state.outputs.cols());
      if (filled) coefficients = state.outputs.row(i);
      const auto [cosine, sine] = cosine_and_sine(coefficients, valid);
      output["amplitude"].push_back(known(filled ? state.amplitudes[i] : std::nan("")));
      output["cosine"].push_back(numbers(cosine));
      output["sine"].push_back(numbers(sine));
    }
    json["dissipated_energy_j"].push_back(known(state.friction_energy));
    json["error_force"].push_back(known(state.error_force));
    json["error_energy"].push_back(known(state.error_energy));
    const Eigen::VectorXd rate =
        valid ? state.wear_rate : Eigen::VectorXd::Constant(state.wear_rate.size(), std::nan(""));
    json["wear_rate_m_per_cycle"].push_back(numbers(rate));
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
