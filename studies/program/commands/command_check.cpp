#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <ostream>
#include <set>
#include <string_view>
#include <thread>

#include "optimizer/candidate/candidate_model.hpp"
#include "optimizer/cases.hpp"
#include "optimizer/evaluation_cost.hpp"
#include "optimizer/scene/scene_kind.hpp"
#include "studies/program/answers/teller.hpp"
#include "studies/program/commands/commands.hpp"
#include "studies/program/engine/engine.hpp"
#include "studies/program/engine/loaded_model.hpp"
#include "studies/program/engine/run_folder.hpp"
#include "studies/program/study_file/best_file.hpp"
#include "studies/report/words/report_words.hpp"

namespace dovetail::studies {
namespace {

/// A sector on so many unknowns was given the sizes of a section, or is far finer than its answers need.
constexpr double kManyUnknowns = 250e3;

/// How the rules of geometry are kept by the design at which a run starts, or the study's own.
std::string fit_words(const Study& study, const optimizer::Scene& scene, const char* design,
                      std::vector<std::string>& doubts) {
  const std::vector<geometry::Rule> rules = rules_in_cases(scene, study.problem.cases);
  const geometry::Rule* closest = nullptr;
  std::set<std::string_view> broken;
  for (const geometry::Rule& rule : rules) {
    // Of the cases in which it is broken the first is named.
    if (rule.margin < 0 && broken.insert(optimizer::split_case(rule.name).response).second)
      doubts.push_back(fmt::format("{} does not fit: {}", design, rule.sentence));
    // Margins of 0 say nothing but kept.
    if (rule.margin > 0 && (closest == nullptr || rule.margin < closest->margin)) closest = &rule;
  }
  if (!broken.empty()) return fmt::format("{} does not fit\n", design);
  return closest == nullptr ? fmt::format("{} fits\n", design)
                            : fmt::format("{} fits; closest to a rule: {}\n", design, closest->sentence);
}

/// What it will cost on this machine, of a design that can be meshed.
std::string cost_words(const Study& study, const optimizer::Scene& scene, std::vector<std::string>& doubts) {
  const optimizer::CandidateSizes sizes = optimizer::sizes_foreseen(reference_scene(study), scene);
  const optimizer::Cost cost = optimizer::cost_foreseen(sizes);
  const optimizer::WorkParams work = optimizer::work_foreseen(sizes.in_space);
  constexpr double kGigabyte = 1e9;
  std::string text = fmt::format(
      "{:.0f} unknowns, about {:.0f} contact nodes; an evaluation takes about {} and {:.2g} GB, with error bars {} and "
      "more memory\n",
      sizes.unknowns, sizes.contact_nodes, time_words(cost.seconds), cost.bytes / kGigabyte,
      time_words(work.bars * cost.seconds));
  if (sizes.in_space && sizes.unknowns > kManyUnknowns)
    doubts.push_back(
        fmt::format("the mesh of the sector has {:.0f} unknowns: sizes of a section are too fine in space; "
                    "`dovetail new FILE --template sector` has sizes for 75 000.",
                    sizes.unknowns));
  if (study.problem.objective.empty() || study.problem.space.size() == 0) return text;
  const auto loads = static_cast<double>(std::max<std::size_t>(study.problem.cases.size(), 1));
  const optimizer::OptimizerOptions& options = study.optimizer;
  double evaluations =
      options.max_evaluations + 2 * work.describe + (options.noise > 0 ? 0 : work.bars) + options.verify * work.verify;
  if (options.departures) evaluations += 2 * static_cast<double>(optimizer::usual_departures().size());
  if (!study.problem.constraints.empty()) evaluations += 2 * options.finer_meshes * work.finer;
  const double seconds =
      optimizer::loads_foreseen(study.problem.cases, study.scene.solver.prestress) * evaluations * cost.seconds;
  return text + fmt::format(
                    "the run: up to {} evaluations{}, with all that follows about {} of one core; this machine "
                    "has {}\n",
                    options.max_evaluations, loads > 1 ? fmt::format(" of {:.0f} cases", loads) : "",
                    time_words(seconds), std::thread::hardware_concurrency());
}

}  // namespace

int run_check(const CheckOptions& options, Teller& teller, const Streams& streams) {
  const Study study = load_rewritten_study(study_or_best(options.study, &teller.remark()), overrides(options.set));
  const optimizer::Problem& problem = study.problem;
  std::vector<std::string> doubts = warnings(study);
  const bool searches = problem.space.size() > 0;
  const optimizer::Scene design = searches ? start_scene(study) : study.scene;
  teller.begin("trying whether the design fits together, before it is meshed");
  std::string foreseen = fit_words(study, design, searches ? "the start design" : "the design", doubts);
  // What does not fit together has no mesh.
  const optimizer::Scene scene = optimizer::in_first_case(design, problem.cases);
  if (optimizer::feasibility_of(scene).feasible) try {
      teller.begin("meshing the design, which comes last");
      foreseen += cost_words(study, scene, doubts);
    } catch (const InputError& error) {
      doubts.push_back(std::string("the design cannot be meshed: ") + error.what());
    }
  teller.end();
  // Where they count as errors they are told as errors are.
  std::ostream& told = options.strict ? streams.err : teller.remark();
  for (const std::string& doubt : doubts)
    told << options.study << (options.strict ? ": " : ": warning: ") << doubt << "\n";
  if (options.strict && !doubts.empty()) return kWrongInput;
  using report::counted;
  streams.out << fmt::format("{}: valid; {}, {}, {}{}\n", options.study, counted(problem.space.size(), "variable"),
                             counted(problem.objective.size(), "objective") + (problem.front ? " for a front" : ""),
                             counted(problem.constraints.size(), "constraint"),
                             problem.cases.empty() ? "" : ", " + counted(problem.cases.size(), "case"))
              << foreseen;
  return kDone;
}

}  // namespace dovetail::studies
