#include "studies/robust/compute.hpp"

#include <algorithm>
#include <atomic>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <set>
#include <sstream>
#include <stdexcept>
#include <thread>

#include "core/errors.hpp"
#include "core/replace_file.hpp"
#include "optimizer/cases.hpp"
#include "optimizer/problem/problem.hpp"
#include "studies/program/commands/commands.hpp"
#include "studies/program/engine/engine.hpp"
#include "studies/program/engine/loaded_model.hpp"
#include "studies/report/record/results_file.hpp"

namespace dovetail::robust {
namespace {

using optimizer::Evaluation;
using studies::Study;

int cores() {
  return static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
}

/// A design in all cases of a study, on all cores: each case is computed by itself.
Evaluation in_all_cases(const Study& study, const optimizer::SceneEvaluator& evaluator, const std::vector<double>& x,
                        const optimizer::Purpose& purpose) {
  const optimizer::Scene scene = studies::scene_at(study, x);
  std::vector<Evaluation> answers(study.problem.cases.size());
  std::atomic<std::size_t> next = 0;
  const auto work = [&] {
    for (std::size_t i = next++; i < answers.size(); i = next++)
      answers[i] = optimizer::evaluated_or_refused(
          [&] { return evaluator.evaluate(optimizer::in_case(scene, study.problem.cases[i]), purpose).evaluation; });
  };
  std::vector<std::jthread> threads;
  for (int i = 0; i < cores(); ++i) threads.emplace_back(work);
  threads.clear();
  Evaluation all = optimizer::together(study.problem.cases, scene, answers);
  optimizer::annotate(study.problem, study.optimizer.constraint_tolerance, all);
  return all;
}

/// The study with that said of where its uncertain numbers are looked at, or of anything else.
Study with(const std::string& file, const std::vector<std::string>& set) {
  return studies::load_study(file, studies::overrides(set));
}

/// A text with every line that begins a key replaced.
std::string with_line(const std::string& text, const std::string& key, const std::string& value) {
  std::istringstream lines(text);
  std::string line, result;
  while (std::getline(lines, line)) result += (line.starts_with(key + " = ") ? key + " = " + value : line) + "\n";
  return result;
}

std::string text_of(const std::string& file) {
  std::ifstream stream(file);
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

/// Runs a search and returns what it ended with: its best design, or the one that comes nearest to the limits.
Design optimum(const std::string& name, const std::string& file, const std::string& folder,
               const ComputeOptions& options) {
  std::ostringstream out;
  options.progress("searching the " + name + ": " + folder);
  const int ended = studies::run_study({.study = file, .directory = folder}, {out, std::cerr}, studies::study_engine);
  if (ended != studies::kDone && ended != studies::kNotConverged)
    throw std::runtime_error("the search of the " + name + " was cut short");
  const report::RunRecord record = report::read_results(folder + "/results.h5");
  const std::optional<std::size_t> at = record.best ? record.best : record.least_broken;
  return {.name = name,
          .x = record.evaluations.at(at.value_or(0)).x,
          .keeps_limits = record.best.has_value(),
          .end = record.message};
}

/// The cases of a study that are left apart where the force is the same in all of them.
Study at_force(Study study, double force) {
  std::vector<optimizer::LoadCase> apart;
  std::set<std::vector<std::pair<double, double>>> seen;
  for (optimizer::LoadCase& load : study.problem.cases) {
    std::vector<std::pair<double, double>> numbers;
    for (optimizer::KeyChange& change : load.changes) {
      if (change.key == "loading.tip_force_n") change.value = force;
      numbers.emplace_back(change.value, change.times);
    }
    if (seen.insert(numbers).second) apart.push_back(load);
  }
  study.problem.cases = std::move(apart);
  return study;
}

}  // namespace

Results compute(const std::string& study_file, const std::string& folder, const ComputeOptions& options) {
  std::filesystem::create_directories(folder);
  std::string text = text_of(study_file);
  if (options.evaluations > 0) text = with_line(text, "max_evaluations", std::to_string(options.evaluations));
  if (options.evaluations > 0) text = with_line(text, "scan_evaluations", std::to_string(options.evaluations / 2));
  const std::string robust = folder + "/robust.toml", nominal = folder + "/nominal.toml";
  replace_file(robust, text);
  replace_file(nominal, with_line(text, "rule", "\"nominal\""));
  Results results{
      .study = studies::load_study(robust),
      .samples = with(robust, {"robust.rule=\"sobol\"", "robust.points=" + std::to_string(options.samples)})};
  results.designs = {{.name = "start", .x = results.study.problem.space.start()},
                     optimum("nominal optimum", nominal, folder + "/nominal", options),
                     optimum("robust optimum", robust, folder + "/robust", options)};
  const auto evaluator = studies::scene_evaluator(results.study);
  results.forces_n = options.forces_n;
  for (const double force : options.forces_n) results.at_force.push_back(at_force(results.study, force));
  for (Design& design : results.designs) {
    options.progress(design.name + " at the corners, with bars");
    design.corners = in_all_cases(results.study, *evaluator, design.x, {.bars = options.bars});
    options.progress(design.name + " in samples");
    design.samples = in_all_cases(results.samples, *evaluator, design.x, optimizer::kSearch);
    options.progress(design.name + " over the force");
    for (const Study& at : results.at_force)
      design.forces.push_back(in_all_cases(at, *evaluator, design.x, optimizer::kSearch));
  }
  return results;
}

}  // namespace dovetail::robust
