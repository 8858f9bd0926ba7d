#include "tests/benchmarks/stages/scene_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "studies/ready_study/processor_time.hpp"

namespace dovetail::benchmarks {

namespace {

constexpr std::array kPartsOfReduction{"factorisation", "modes", "trace"};
constexpr const char* kWhole = "whole";
constexpr const char* kErrorBars = "error_bars";

bool is_part(const std::string& stage) {
  return std::ranges::find(kPartsOfReduction, stage) != kPartsOfReduction.end();
}

/// Stages up to the last one that is measured, each measured or run for those after it.
void run(std::vector<Stage>& stages, const Selection& selection, Measurement& measurement, SceneReport& report) {
  const auto measured = [&](const Stage& stage) { return selection.contains(stage.work.name); };
  const bool parts = selection.limits || std::ranges::any_of(stages, [&](const Stage& stage) {
                       return is_part(stage.work.name) && measured(stage);
                     });
  const auto last = std::find_if(stages.rbegin(), stages.rend(), measured).base();
  const auto end = selection.limits ? stages.end() : last;
  for (auto stage = stages.begin(); stage != end; ++stage) {
    if (measured(*stage))
      report.stages.push_back({.name = stage->work.name, .seconds = measurement.seconds(stage->work), .needs = {}});
    else if (parts || !is_part(stage->work.name))
      run_aside(stage->work);
    // Before a later stage renews what it has spent.
    if (measured(*stage) && selection.limits) report.stages.back().needs = stage->needs();
  }
}

/// The needs of the stages that an evaluation comes through.
Needs needs_of_whole(const std::vector<Stage>& stages, const SceneReport& report) {
  Needs whole;
  for (const StageReport& stage : report.stages)
    if (!is_part(stage.name) && std::ranges::any_of(stages, [&](const Stage& s) { return s.work.name == stage.name; }))
      for (const auto& [kernel, units] : stage.needs) whole[kernel] += units;
  // Stages know the order of elimination; a whole evaluation finds it if it factorises.
  if (whole[kFactorisation] > 0) whole[kOrder] = 1;
  return whole;
}

double seconds_of(const SceneReport& report, const Needs& needs) {
  double seconds = 0;
  for (const KernelReport& of : report.kernels)
    if (const auto found = needs.find(of.kernel.work.name); found != needs.end())
      seconds += found->second / of.kernel.units * ready_study::median(of.seconds);
  return seconds;
}

std::string words(const SceneReport& report, const Needs& needs) {
  std::string result;
  for (const KernelReport& of : report.kernels) {
    const auto found = needs.find(of.kernel.work.name);
    if (found == needs.end() || found->second == 0) continue;
    const double per = of.kernel.per > 0 ? of.kernel.per : of.kernel.units;
    result += fmt::format("{}{:.3g} {}", result.empty() ? "" : " + ", found->second / per, of.kernel.words);
  }
  return result.empty() ? "no limit known" : result;
}

}  // namespace

bool Selection::contains(const std::string& stage) const {
  if (stages.empty()) return stage != kErrorBars || error_bars;
  return stages.contains(stage);
}

SceneReport measure(const BenchmarkScene& scene, const Selection& selection, Measurement& measurement) {
  Chain chain(scene);
  SceneReport report{.scene = std::string(scene.name), .stages = {}, .kernels = {}};
  std::vector<Stage> stages = model_stages(chain);
  for (Stage& stage : contact_stages(chain)) stages.push_back(std::move(stage));
  const bool chained =
      selection.limits || std::ranges::any_of(stages, [&](const Stage& s) { return selection.contains(s.work.name); });
  if (chained) run(stages, selection, measurement, report);
  for (Stage& stage : whole_stages(chain))
    if (selection.contains(stage.work.name))
      report.stages.push_back({.name = stage.work.name, .seconds = measurement.seconds(stage.work), .needs = {}});
  if (!selection.limits) return report;
  report.unknowns = static_cast<double>(chain.candidate.matrices.shared->system.size());
  report.trace = chain.trace_size();
  report.contact_nodes = static_cast<double>(chain.fitted.cells.count());
  for (StageReport& stage : report.stages)
    if (stage.name == kWhole) stage.needs = needs_of_whole(stages, report);
  for (Kernel& kernel : kernels(chain)) {
    std::vector<double> seconds = measurement.seconds(kernel.work);
    report.kernels.push_back({.kernel = std::move(kernel), .seconds = std::move(seconds)});
  }
  return report;
}

void print(const SceneReport& report) {
  std::printf("\n%s: %.0f unknowns, %.0f contact dofs on the trace, %.0f contact nodes\n", report.scene.c_str(),
              report.unknowns, report.trace, report.contact_nodes);
  std::printf("%-18s %10s %12s %9s  %s\n", "stage", "ms", "unavoidable", "distance", "made of");
  for (const StageReport& stage : report.stages) {
    const double seconds = ready_study::median(stage.seconds), limit = seconds_of(report, stage.needs);
    const std::string distance = limit > 0 ? fmt::format("{:.2f}", seconds / limit) : "-";
    std::printf("%-18s %10.3f %12.3f %9s  %s\n", stage.name.c_str(), 1e3 * seconds, 1e3 * limit, distance.c_str(),
                words(report, stage.needs).c_str());
  }
}

nlohmann::json to_json(const SceneReport& report) {
  nlohmann::json stages = nlohmann::json::object(), kernels = nlohmann::json::object();
  for (const StageReport& stage : report.stages)
    stages[stage.name] = {{"seconds", stage.seconds}, {"needs", stage.needs}, {"limit", words(report, stage.needs)}};
  for (const KernelReport& of : report.kernels)
    kernels[of.kernel.work.name] = {{"seconds", of.seconds}, {"units", of.kernel.units}};
  return {
      {"unknowns", report.unknowns}, {"contact_nodes", report.contact_nodes}, {"stages", stages}, {"kernels", kernels}};
}

}  // namespace dovetail::benchmarks
