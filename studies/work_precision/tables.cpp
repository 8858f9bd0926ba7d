#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "studies/work_precision/results.hpp"

namespace dovetail::work_precision {
namespace {

using Json = nlohmann::ordered_json;

std::string number(double value) {
  return std::isfinite(value) ? fmt::format("{:.17g}", value) : "";
}

// In quotes when it holds what separates.
std::string field(const std::string& text) {
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? "\"\"" : std::string(1, c);
  return quoted + "\"";
}

Json json_of(const Run& run) {
  const Setting& s = run.setting;
  Json json{{"harmonics", s.harmonics},
            {"samples", s.samples},
            {"penalty_ratio", s.penalty},
            {"solver", s.solver},
            {"penalty_cascade", s.cascade},
            {"slip_return", s.slip_return},
            {"modes", s.modes},
            {"flank_elements", s.flank_elements},
            {"status", run.status},
            {"seconds", run.seconds},
            {"model_seconds", run.model_seconds},
            {"solves", run.solves},
            {"jacobians", run.jacobians},
            {"nodes_stuck", run.stuck},
            {"nodes_slipping", run.slipping},
            {"nodes_separating", run.separating}};
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
  return {{"key", sweep.key}, {"title", sweep.title}, {"verdict", verdict(sweep, kGoal)}, {"lines", lines}};
}

Json json_of(const StepTimes& t) {
  return {{"status", std::string(to_string(t.status))},
          {"nodes", t.nodes},
          {"harmonics", t.harmonics},
          {"samples", t.samples},
          {"unknowns", t.unknowns},
          {"factorised", t.factorised},
          {"nodes_stuck", t.stuck},
          {"residual_s", t.residual},
          {"residual_and_derivative_s", t.derivative},
          {"dense_jacobian_s", t.jacobian},
          {"full_lu_s", t.lu},
          {"linearise_s", t.linearise},
          {"solve_s", t.solve},
          {"newton_step_s", t.step}};
}

}  // namespace

std::string table_csv(const Results& results) {
  std::string text =
      "model,sweep,line,label,default,harmonics,samples,penalty_ratio,solver,penalty_cascade,slip_return,modes,"
      "flank_elements,status,seconds,model_seconds,solves,jacobians";
  for (const char* prefix : {"", "error_", "own_error_"})
    for (const char* quantity : kQuantityKeys) text += std::string(",") + prefix + quantity;
  text += "\n";
  for (const Diagram& diagram : results.diagrams)
    for (const Sweep& sweep : diagram.sweeps)
      for (const Line& line : sweep.lines)
        for (const Point& point : line.points) {
          const Setting& s = point.run.setting;
          text += fmt::format("{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{}", diagram.key, sweep.key,
                              field(line.name), field(point.label), point.is_default ? 1 : 0, s.harmonics, s.samples,
                              number(s.penalty), s.solver, s.cascade ? 1 : 0, s.slip_return, s.modes, s.flank_elements,
                              field(point.run.status), number(point.run.seconds), number(point.run.model_seconds),
                              point.run.solves, point.run.jacobians);
          for (const double value : point.run.value) text += "," + (point.run.converged() ? number(value) : "");
          for (const double error : point.error) text += "," + number(error);
          for (const double error : point.own_error) text += "," + number(error);
          text += "\n";
        }
  return text;
}

std::string growth_csv(const Results& results) {
  std::string text =
      "over,status,nodes,harmonics,samples,unknowns,factorised,nodes_stuck,residual_s,residual_and_derivative_s,"
      "dense_jacobian_s,full_lu_s,linearise_s,solve_s,newton_step_s\n";
  for (const Growth& growth : results.growth)
    for (const StepTimes& t : growth.times)
      text += fmt::format("{},{},{},{},{},{},{},{},{},{},{},{},{},{},{}\n", growth.key, to_string(t.status), t.nodes,
                          t.harmonics, t.samples, t.unknowns, t.factorised, t.stuck, number(t.residual),
                          number(t.derivative), number(t.jacobian), number(t.lu), number(t.linearise), number(t.solve),
                          number(t.step));
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
    Json times = Json::array();
    for (const StepTimes& t : growth.times) times.push_back(json_of(t));
    growths.push_back({{"over", growth.key}, {"fixed", growth.fixed}, {"steps", times}});
  }
  const Circumstances& made = results.made;
  return Json{{"commit", made.commit},   {"machine", made.machine},   {"system", made.system},
              {"blas", made.blas},       {"compiler", made.compiler}, {"date_utc", made.date_utc},
              {"seconds", made.seconds}, {"quick", made.quick},       {"models", diagrams},
              {"newton_step", growths}}
             .dump(1) +
         "\n";
}

}  // namespace dovetail::work_precision
