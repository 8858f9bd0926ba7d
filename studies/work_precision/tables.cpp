#include <fmt/format.h>

#include "optimizer/journal/record_json.hpp"
#include "studies/ready_study/csv.hpp"
#include "studies/work_precision/evaluations/tables.hpp"
#include "studies/work_precision/results.hpp"

namespace dovetail::optimizer {

using work_precision::Run, work_precision::Setting, work_precision::StepTimes;

template <>
inline constexpr auto kFields<Setting> = std::tuple{RecordField{"harmonics", &Setting::harmonics},
                                                    RecordField{"samples", &Setting::samples},
                                                    RecordField{"penalty_ratio", &Setting::penalty},
                                                    RecordField{"solver", &Setting::solver},
                                                    RecordField{"penalty_cascade", &Setting::cascade},
                                                    RecordField{"slip_return", &Setting::slip_return},
                                                    RecordField{"modes", &Setting::modes},
                                                    RecordField{"flank_elements", &Setting::flank_elements}};

/// Besides its setting and values.
template <>
inline constexpr auto kFields<Run> = std::tuple{RecordField{"status", &Run::status},
                                                RecordField{"seconds", &Run::seconds},
                                                RecordField{"model_seconds", &Run::model_seconds},
                                                RecordField{"solves", &Run::solves},
                                                RecordField{"jacobians", &Run::jacobians},
                                                RecordField{"nodes_stuck", &Run::stuck},
                                                RecordField{"nodes_slipping", &Run::slipping},
                                                RecordField{"nodes_separating", &Run::separating}};

template <>
inline constexpr auto kFields<StepTimes> = std::tuple{RecordField{"status", &StepTimes::status},
                                                      RecordField{"nodes", &StepTimes::nodes},
                                                      RecordField{"harmonics", &StepTimes::harmonics},
                                                      RecordField{"samples", &StepTimes::samples},
                                                      RecordField{"unknowns", &StepTimes::unknowns},
                                                      RecordField{"factorised", &StepTimes::factorised},
                                                      RecordField{"nodes_stuck", &StepTimes::stuck},
                                                      RecordField{"residual_s", &StepTimes::residual},
                                                      RecordField{"residual_and_derivative_s", &StepTimes::derivative},
                                                      RecordField{"dense_jacobian_s", &StepTimes::jacobian},
                                                      RecordField{"full_lu_s", &StepTimes::lu},
                                                      RecordField{"linearise_s", &StepTimes::linearise},
                                                      RecordField{"solve_s", &StepTimes::solve},
                                                      RecordField{"newton_step_s", &StepTimes::step}};

}  // namespace dovetail::optimizer

namespace dovetail::work_precision {
namespace {

using Json = nlohmann::ordered_json;
using ready_study::csv_text;
using ready_study::csv_value;

Json json_of(const Run& run) {
  Json json = optimizer::json_value<Json>(run.setting);
  json.update(optimizer::json_value<Json>(run));
  for (std::size_t q = 0; q < kQuantityKeys.size(); ++q)
    json[kQuantityKeys[q]] = run.converged() ? Json(run.value[q]) : Json();
  return json;
}

// NaN becomes null.
Json errors_of(const std::array<double, 3>& errors) {
  Json json = Json::object();
  for (std::size_t q = 0; q < kQuantityKeys.size(); ++q) json[kQuantityKeys[q]] = errors[q];
  return json;
}

Json json_of(const Reference& reference) {
  return {{"run", json_of(reference.run)},
          {"check", json_of(reference.check)},
          {"agreement", errors_of(reference.agreement)}};
}

Json json_of(const Sweep& sweep) {
  Json lines = Json::array();
  for (const Line& line : sweep.lines) {
    Json points = Json::array();
    for (const Point& point : line.points) {
      Json json = json_of(point.run);
      json["label"] = point.label;
      json["default"] = point.is_default;
      json["error"] = errors_of(point.error);
      json["own_error"] = errors_of(point.own_error);
      points.push_back(std::move(json));
    }
    lines.push_back({{"name", line.name}, {"points", points}});
  }
  return {{"key", to_string(sweep.key)}, {"title", sweep.title}, {"verdict", verdict(sweep, kGoal)}, {"lines", lines}};
}

}  // namespace

std::string table_csv(const Results& results) {
  std::string text =
      "model,sweep,line,label,default" + ready_study::csv_names<Setting>() + ready_study::csv_names<Run>();
  for (const char* prefix : {"", "error_", "own_error_"})
    for (const char* quantity : kQuantityKeys) text += std::string(",") + prefix + quantity;
  text += "\n";
  for (const Diagram& diagram : results.diagrams)
    for (const Sweep& sweep : diagram.sweeps)
      for (const Line& line : sweep.lines)
        for (const Point& point : line.points) {
          text += fmt::format("{},{},{},{},{}", diagram.key, to_string(sweep.key), csv_text(line.name),
                              csv_text(point.label), point.is_default ? 1 : 0) +
                  ready_study::csv_values(point.run.setting) + ready_study::csv_values(point.run);
          for (const double value : point.run.value) text += "," + (point.run.converged() ? csv_value(value) : "");
          for (const auto* errors : {&point.error, &point.own_error})
            for (const double error : *errors) text += "," + csv_value(error);
          text += "\n";
        }
  return text;
}

std::string growth_csv(const Results& results) {
  std::string text = "over" + ready_study::csv_names<StepTimes>() + "\n";
  for (const Growth& growth : results.growth)
    for (const StepTimes& times : growth.times) text += growth.key + ready_study::csv_values(times) + "\n";
  return text;
}

std::string table_json(const Results& results) {
  Json diagrams = Json::array(), growths = Json::array();
  for (const Diagram& diagram : results.diagrams) {
    Json sweeps = Json::array();
    for (const Sweep& sweep : diagram.sweeps) sweeps.push_back(json_of(sweep));
    Json json{{"key", diagram.key},
              {"title", diagram.title},
              {"description", diagram.description},
              {"reference", json_of(diagram.reference)}};
    if (diagram.mesh_reference) json["mesh_reference"] = json_of(*diagram.mesh_reference);
    json["sweeps"] = sweeps;
    diagrams.push_back(std::move(json));
  }
  for (const Growth& growth : results.growth) {
    growths.push_back(
        {{"over", growth.key}, {"fixed", growth.fixed}, {"steps", optimizer::json_value<Json>(growth.times)}});
  }
  const Circumstances& made = results.made;
  return Json{{"commit", made.commit},
              {"machine", made.machine},
              {"system", made.system},
              {"blas", made.blas},
              {"compiler", made.compiler},
              {"date_utc", made.date_utc},
              {"seconds", made.seconds},
              {"quick", made.quick},
              {"models", diagrams},
              {"newton_step", growths},
              {"evaluations", evaluations_json(results.evaluations)}}
             .dump(1) +
         "\n";
}

}  // namespace dovetail::work_precision
