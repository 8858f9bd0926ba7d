#include "studies/report/record/run_record.hpp"

#include <H5public.h>
#include <fmt/core.h>
#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <limits>

#include "core/options.hpp"

namespace dovetail::report {

namespace {

std::string now_utc() {
  const std::time_t now = std::time(nullptr);
  std::tm parts{};
  gmtime_r(&now, &parts);
  char text[32];
  const std::size_t size = std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &parts);
  return {text, size};
}

EvaluationRecord evaluation_of(const optimizer::Candidate& candidate, std::size_t limits) {
  const optimizer::Evaluation& evaluation = candidate.evaluation;
  EvaluationRecord record{.x = candidate.x,
                          .phase = candidate.phase,
                          .status = evaluation.status,
                          .feasible = candidate.judgement.feasible,
                          .objective = candidate.judgement.objective,
                          .violation = candidate.judgement.violation,
                          .constraints = candidate.judgement.constraints,
                          .seconds = 0,
                          .responses = evaluation.responses,
                          .error_estimates = evaluation.error_estimates,
                          .rules = {},
                          .messages = evaluation.messages};
  const std::string prefix = optimizer::kRulePrefix;
  for (const auto& [name, c] : evaluation.constraints)
    if (name.starts_with(prefix)) record.rules[name.substr(prefix.size())] = c;
  record.constraints.resize(limits, std::numeric_limits<double>::quiet_NaN());
  if (const auto total = evaluation.timings_s.find("total"); total != evaluation.timings_s.end())
    record.seconds = total->second;
  return record;
}

std::map<std::string, std::string> texts(const optimizer::OptimizerOptions& options) {
  std::map<std::string, std::string> result;
  for (const Field<optimizer::OptimizerOptions>& field : option_table<optimizer::OptimizerOptions>()) {
    const std::string key(field.key);
    if (const std::optional<std::string> text = text_in(options, field))
      result[key] = *text;
    else if (const auto* truth = std::get_if<bool optimizer::OptimizerOptions::*>(&field.member))
      result[key] = options.*(*truth) ? "true" : "false";
    else
      result[key] = shortest(value_in_file_unit(options, field));
  }
  return result;
}

}  // namespace

Provenance provenance() {
  Provenance result;
  result.date_utc = now_utc();
  result.compiler = std::string("g++ ") + __VERSION__;
  result.libraries = {
      {"Eigen", fmt::format("{}.{}.{}", EIGEN_WORLD_VERSION, EIGEN_MAJOR_VERSION, EIGEN_MINOR_VERSION)},
      {"HDF5", fmt::format("{}.{}.{}", H5_VERS_MAJOR, H5_VERS_MINOR, H5_VERS_RELEASE)},
      {"fmt", fmt::format("{}.{}.{}", FMT_VERSION / 10000, FMT_VERSION / 100 % 100, FMT_VERSION % 100)}};
  return result;
}

RunRecord record_run(const optimizer::Problem& problem, const optimizer::OptimizerOptions& options,
                     const optimizer::OptimizationResult& result) {
  RunRecord record;
  record.status = std::string(to_string(result.status));
  record.message = result.message;
  record.problem = problem;
  const std::size_t limits = constraint_names(problem).size();
  for (const optimizer::Candidate& candidate : result.evaluations)
    record.evaluations.push_back(evaluation_of(candidate, limits));
  for (const optimizer::FinerCheck& check : result.finer)
    record.finer.push_back({.evaluation = static_cast<std::int64_t>(check.candidate),
                            .flank_elements = check.flank_elements(),
                            .status = check.evaluation.status,
                            .constraints = check.constraints});
  record.best = result.best;
  record.least_broken = result.least_broken;
  if (!result.evaluations.empty()) record.baseline = 0;
  record.provenance = provenance();
  record.provenance.options = texts(options);
  return record;
}

std::string VerificationRecord::agreement() const {
  if (!optimizer::converged(status)) return status;
  return search_bar_m3 < search_volume_m3 || search_volume_m3 == 0 ? "agree within their bars"
                                                                   : "cannot tell: the bar is larger than the value";
}

std::vector<std::size_t> worst_line(const std::vector<std::int64_t>& flanks, const Numbers& across,
                                    const Numbers& values, std::int64_t flank) {
  const auto place = [&](std::size_t i) { return i < across.size() ? across[i] : 0.0; };
  std::optional<std::size_t> worst;
  for (std::size_t i = 0; i < std::min(flanks.size(), values.size()); ++i)
    if (flanks[i] == flank && (!worst || values[i] > values[*worst])) worst = i;
  std::vector<std::size_t> line;
  if (!worst) return line;
  // Lines of the grid are tenths of a millimetre apart at least; places on one differ by rounding.
  constexpr double kSameLine = 1e-7;
  for (std::size_t i = 0; i < flanks.size(); ++i)
    if (flanks[i] == flank && std::abs(place(i) - place(*worst)) < kSameLine) line.push_back(i);
  return line;
}

}  // namespace dovetail::report
