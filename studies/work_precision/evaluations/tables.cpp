#include "studies/work_precision/evaluations/tables.hpp"

#include <fmt/format.h>

#include <set>

#include "optimizer/journal/record_json.hpp"
#include "optimizer/responses/response_table.hpp"
#include "studies/ready_study/csv.hpp"
#include "studies/work_precision/evaluations/verdicts.hpp"

namespace dovetail::optimizer {

using work_precision::WholeRun, work_precision::WholeSetting;

template <>
inline constexpr auto kFields<WholeSetting> =
    std::tuple{RecordField{"mesh", &WholeSetting::mesh},
               RecordField{"beside", &WholeSetting::beside},
               RecordField{"harmonics", &WholeSetting::harmonics},
               RecordField{"samples", &WholeSetting::samples},
               RecordField{"modes", &WholeSetting::modes},
               RecordField{"resonance_tolerance", &WholeSetting::resonance_tolerance},
               RecordField{"history_tolerance", &WholeSetting::history_tolerance},
               RecordField{"residual_tolerance", &WholeSetting::tolerance},
               RecordField{"solver", &WholeSetting::solver}};

/// Besides its setting, stages and responses.
template <>
inline constexpr auto kFields<WholeRun> = std::tuple{RecordField{"status", &WholeRun::status},
                                                     RecordField{"seconds", &WholeRun::seconds},
                                                     RecordField{"setup_seconds", &WholeRun::setup_seconds},
                                                     RecordField{"repetitions", &WholeRun::repetitions},
                                                     RecordField{"dofs", &WholeRun::dofs},
                                                     RecordField{"contact_nodes", &WholeRun::contact_nodes},
                                                     RecordField{"worn_in_steps", &WholeRun::in_steps}};

}  // namespace dovetail::optimizer

namespace dovetail::work_precision {
namespace {

using Json = nlohmann::ordered_json;
using ready_study::csv_text;
using ready_study::csv_value;

double value_of(const std::map<std::string, double>& values, const std::string& key) {
  const auto found = values.find(key);
  return found == values.end() ? kUnknown : found->second;
}

/// Calls visit(line, point) for all points of a diagram, its references first.
template <class Visit>
void each_point(const WholeDiagram& diagram, Visit&& visit) {
  visit("reference", diagram.reference.finest);
  visit("reference", diagram.reference.check);
  for (const WholeLine& line : diagram.lines)
    for (const WholePoint& point : line.points) visit(std::string(to_string(line.key)), point);
  for (const AutomaticChoice& choice : diagram.automatic) visit("automatic", choice.point);
}

std::set<std::string> stages_of(const std::vector<WholeDiagram>& diagrams) {
  std::set<std::string> stages;
  for (const WholeDiagram& diagram : diagrams)
    each_point(diagram, [&](const std::string&, const WholePoint& point) {
      for (const auto& [stage, seconds] : point.run.timings_s) stages.insert(stage);
    });
  return stages;
}

Json json_of(const WholePoint& point) {
  Json json{{"label", point.label}};
  json.update(optimizer::json_value<Json>(point.run.setting));
  json.update(optimizer::json_value<Json>(point.run));
  json["timings_s"] = optimizer::json_value<Json>(point.run.timings_s);
  json["responses"] = optimizer::json_value<Json>(point.run.responses);
  json["error"] = optimizer::json_value<Json>(point.error);
  json["worst_error"] = optimizer::json_value<Json>(point.worst);
  return json;
}

Json json_of(const optimizer::SettingsTried& tried) {
  const optimizer::Settings& s = tried.settings;
  Json json{{"mesh", s.mesh},       {"beside", s.beside}, {"harmonics", s.harmonics},
            {"samples", s.samples}, {"modes", s.modes},   {"status", tried.status}};
  json["bar_over_allowed"] = optimizer::json_value<Json>(tried.excess);
  if (tried.by) {
    json["most_by"] = {{"response", tried.by->response}, {"source", tried.by->source}};
    json["relative_bar"] = tried.by->relative;
  }
  json["operations"] = tried.operations;
  return json;
}

Json json_of(const WholeDiagram& diagram, const AutomaticChoice& choice) {
  const auto other = [](const WholePoint* point) {
    return point == nullptr ? Json()
                            : Json{{"label", point->label},
                                   {"setting", optimizer::json_value<Json>(point->run.setting)},
                                   {"seconds", point->run.seconds},
                                   {"worst_error", point->worst}};
  };
  const Comparison comparison = compare(diagram, choice);
  Json rounds = Json::array();
  for (const optimizer::SettingsTried& tried : choice.rounds) rounds.push_back(json_of(tried));
  return {{"asked", choice.asked},
          {"status", choice.status},
          {"most_of_the_bar_by", choice.most_by},
          {"relative_bar", optimizer::json_value<Json>(choice.relative_bar)},
          {"choice_seconds", choice.seconds},
          {"point", json_of(choice.point)},
          {"cheapest_for_asked", other(comparison.for_asked)},
          {"factor_for_asked", optimizer::json_value<Json>(comparison.factor_asked)},
          {"cheapest_steady_for_asked", other(comparison.steady)},
          {"factor_steady", optimizer::json_value<Json>(comparison.factor_steady)},
          {"cheapest_for_its_error", other(comparison.for_error)},
          {"factor_for_its_error", optimizer::json_value<Json>(comparison.factor_error)},
          {"verdict", choice_verdict(diagram, choice)},
          {"rounds", rounds}};
}

Json front_json(const WholeDiagram& diagram, const std::string& response) {
  Json json = Json::array();
  for (const WholePoint* point : front(diagram, response))
    json.push_back({{"seconds", point->run.seconds}, {"error", error_of(*point, response)}, {"label", point->label}});
  return json;
}

Json json_of(const WholeDiagram& diagram) {
  Json lines = Json::array(), choices = Json::array(), fronts = Json::object();
  for (const WholeLine& line : diagram.lines) {
    Json points = Json::array();
    for (const WholePoint& point : line.points) points.push_back(json_of(point));
    lines.push_back({{"key", to_string(line.key)}, {"points", points}});
  }
  for (const AutomaticChoice& choice : diagram.automatic) choices.push_back(json_of(diagram, choice));
  fronts["worst"] = front_json(diagram, kWorst);
  for (const auto& [name, error] : diagram.reference.check.error) fronts[name] = front_json(diagram, name);
  return {{"key", diagram.key},
          {"title", diagram.title},
          {"description", diagram.description},
          {"variables", optimizer::json_value<Json>(diagram.variables)},
          {"judged_responses", diagram.judged},
          {"judged_by_study", diagram.judged_by_study},
          {"reference", {{"finest", json_of(diagram.reference.finest)}, {"check", json_of(diagram.reference.check)}}},
          {"references_agree_to", optimizer::json_value<Json>(diagram.agreement())},
          {"paper", paper_verdict(diagram)},
          {"lines", lines},
          {"automatic", choices},
          {"fronts", fronts}};
}

}  // namespace

std::string evaluations_csv(const std::vector<WholeDiagram>& diagrams) {
  std::string text = "design,line,label" + ready_study::csv_names<WholeSetting>() + ready_study::csv_names<WholeRun>();
  const std::set<std::string> stages = stages_of(diagrams);
  for (const std::string& stage : stages) text += "," + stage + "_s";
  for (const optimizer::Response& response : optimizer::responses()) text += "," + std::string(response.name);
  text += ",error_worst";
  for (const optimizer::Response& response : optimizer::responses()) text += ",error_" + std::string(response.name);
  text += "\n";
  for (const WholeDiagram& diagram : diagrams)
    each_point(diagram, [&](const std::string& line, const WholePoint& point) {
      text += fmt::format("{},{},{}", diagram.key, line, csv_text(point.label)) +
              ready_study::csv_values(point.run.setting) + ready_study::csv_values(point.run);
      for (const std::string& stage : stages) text += "," + csv_value(value_of(point.run.timings_s, stage));
      for (const optimizer::Response& response : optimizer::responses())
        text += "," + csv_value(value_of(point.run.responses, std::string(response.name)));
      text += "," + csv_value(point.worst);
      for (const optimizer::Response& response : optimizer::responses())
        text += "," + csv_value(value_of(point.error, std::string(response.name)));
      text += "\n";
    });
  return text;
}

nlohmann::ordered_json evaluations_json(const std::vector<WholeDiagram>& diagrams) {
  Json json = Json::array();
  for (const WholeDiagram& diagram : diagrams) json.push_back(json_of(diagram));
  return json;
}

}  // namespace dovetail::work_precision
