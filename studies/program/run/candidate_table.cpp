#include "studies/program/run/candidate_table.hpp"

#include <cmath>
#include <set>

#include "core/options.hpp"

namespace dovetail::studies {
namespace {

std::string value_of(const std::map<std::string, double>& values, const std::string& name) {
  const auto found = values.find(name);
  return found == values.end() ? "" : table_number(found->second);
}

}  // namespace

std::string csv_cell(const std::string& text) {
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
}

std::string table_number(double value) {
  return std::isfinite(value) ? shortest(value) : "";
}

std::string candidate_table(const report::RunRecord& record) {
  std::set<std::string> responses, barred;
  for (const report::EvaluationRecord& evaluation : record.evaluations) {
    for (const auto& [name, value] : evaluation.responses) responses.insert(name);
    for (const auto& [name, bar] : evaluation.error_estimates) barred.insert(name);
  }
  std::string text = "evaluation,phase,status,feasible,objective,violation,seconds";
  for (const std::string& key : record.problem.space.keys()) text += "," + csv_cell(key);
  for (const std::string& name : responses)
    text += "," + csv_cell(name) + (barred.contains(name) ? "," + csv_cell(name + "_bar") : "");
  for (const std::string& name : constraint_names(record.problem)) text += "," + csv_cell("constraint " + name);
  text += "\n";
  for (std::size_t i = 0; i < record.evaluations.size(); ++i) {
    const report::EvaluationRecord& at = record.evaluations[i];
    text += std::to_string(i + 1) + "," + csv_cell(at.phase) + "," + csv_cell(at.status) +
            (at.feasible ? ",true" : ",false");
    for (const double value : {at.objective, at.violation, at.seconds}) text += "," + table_number(value);
    for (const double x : at.x) text += "," + table_number(x);
    for (const std::string& name : responses)
      text +=
          "," + value_of(at.responses, name) + (barred.contains(name) ? "," + value_of(at.error_estimates, name) : "");
    for (const double c : at.constraints) text += "," + table_number(c);
    text += "\n";
  }
  return text;
}

}  // namespace dovetail::studies
