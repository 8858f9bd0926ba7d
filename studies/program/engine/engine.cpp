#include "studies/program/engine/engine.hpp"

#include <algorithm>
#include <map>
#include <mutex>
#include <utility>

#include "optimizer/cases.hpp"
#include "optimizer/responses/response_table.hpp"
#include "studies/report/record/design_record.hpp"

namespace dovetail::studies {

using optimizer::Scene;
using optimizer::SceneEvaluator;

Scene scene_at(const Study& study, std::span<const double> x) {
  Scene scene = study.scene;
  for (const auto& [key, value] : settings_at(study, x)) optimizer::set_parameter(scene, key, value);
  return scene;
}

Scene start_scene(const Study& study) {
  return scene_at(study, study.problem.space.start());
}

Scene reference_scene(const Study& study) {
  std::vector<double> middle;
  for (const optimizer::DesignVariable& variable : study.problem.space.variables())
    middle.push_back(variable.lower + (variable.upper - variable.lower) / 2);
  return scene_at(study, middle);
}

std::vector<optimizer::MissionCases> study_missions(const Study& study, bool all) {
  const bool named = optimizer::of_a_mission(optimizer::responses_of(study.problem));
  // Loads whose resonances are followed as the joint wears have no mission: one that is named is refused.
  const bool held = study.scene.loading.follow == wear::Follow::fixed;
  // In space it takes minutes: only where it is asked for.
  if (!held || (!named && (!all || study.scene.kind->in_space))) return {};
  return optimizer::missions_of(study.problem.cases, named);
}

Scene evaluator_reference(const Study& study) {
  Scene scene = reference_scene(study);
  if (scene.solver.prestress == optimizer::Prestress::cases)
    scene.contact.friction = optimizer::in_first_case(scene, study.problem.cases).contact.friction;
  return scene;
}

std::shared_ptr<const SceneEvaluator> scene_evaluator(const Study& study) {
  return std::make_shared<const SceneEvaluator>(evaluator_reference(study), optimizer::responses_of(study.problem));
}

namespace {

/// A design that the evaluator refuses is one that failed: a run ends with a report all the same.
optimizer::CandidateResult evaluated(const SceneEvaluator& evaluator, const Scene& scene,
                                     const optimizer::Purpose& purpose) {
  optimizer::CandidateResult result;
  result.evaluation = optimizer::evaluated_or_refused([&] {
    result = evaluator.evaluate(scene, purpose);
    return result.evaluation;
  });
  if (!result.evaluation.parameters.empty()) return result;
  result.evaluation.parameters = optimizer::parameters(scene);
  result.model.status = result.evaluation.status;  // there is none
  return result;
}

/// What all loads of a design wear off together, as a candidate of a search.
optimizer::Evaluation mission_piece(const SceneEvaluator& evaluator, optimizer::MissionLoads loads,
                                    const Piece& piece) {
  if (piece.what == Piece::What::finer) return optimizer::mission_finer(evaluator, std::move(loads), piece.number);
  if (piece.what == Piece::What::departed)
    for (optimizer::MissionLoads::Load& load : loads.all)
      load.scene = optimizer::in_case(std::move(load.scene),
                                      optimizer::usual_departures()[static_cast<std::size_t>(piece.number)]);
  const bool closely = piece.what == Piece::What::barred;
  return evaluator.evaluate_mission(loads, {.bars = closely, .history = closely});
}

/// Designs with bars and what the wear history decides. The best one is verified and then described: it is computed
/// once. Several threads may look at designs.
class CloserLook {
 public:
  CloserLook(std::shared_ptr<const SceneEvaluator> evaluator, optimizer::Stage until)
      : evaluator_(std::move(evaluator)), purpose_{.until = until} {}

  [[nodiscard]] const SceneEvaluator& evaluator() const { return *evaluator_; }

  /// The first one is kept until it is taken.
  std::shared_ptr<const optimizer::CandidateResult> look(const Scene& scene) {
    {
      const std::scoped_lock lock(mutex_);
      if (kept_ && kept_->evaluation.parameters == optimizer::parameters(scene)) return kept_;
    }
    auto result = std::make_shared<const optimizer::CandidateResult>(evaluated(*evaluator_, scene, purpose_));
    const std::scoped_lock lock(mutex_);
    seen_.insert_or_assign(optimizer::parameters(scene), result->evaluation);
    if (!kept_) kept_ = result;
    return result;
  }

  std::shared_ptr<const optimizer::CandidateResult> take(const Scene& scene) {
    auto result = look(scene);
    const std::scoped_lock lock(mutex_);
    if (kept_ == result) kept_.reset();
    return result;
  }

  /// Of one that need not be kept.
  optimizer::Evaluation evaluation(const Scene& scene) {
    {
      const std::scoped_lock lock(mutex_);
      if (const auto found = seen_.find(optimizer::parameters(scene)); found != seen_.end()) return found->second;
    }
    return evaluated(*evaluator_, scene, purpose_).evaluation;
  }

 private:
  std::shared_ptr<const SceneEvaluator> evaluator_;
  optimizer::Purpose purpose_;
  std::mutex mutex_;  // of what follows
  std::shared_ptr<const optimizer::CandidateResult> kept_;
  std::map<std::map<std::string, double>, optimizer::Evaluation> seen_;
};

}  // namespace

RunEngine study_engine(const Study& study) {
  const std::shared_ptr<const SceneEvaluator> evaluator = scene_evaluator(study);
  RunEngine engine;
  const auto design_at = [own = std::make_shared<const Study>(study)](std::span<const double> x) {
    return scene_at(*own, x);
  };
  optimizer::Purpose purpose = optimizer::kSearch;
  if (study.optimizer.responses == optimizer::Answers::needed)
    purpose.until = optimizer::last_stage(optimizer::responses_of(study.problem));
  const std::vector<optimizer::LoadCase> cases = study.problem.cases;
  const std::vector<optimizer::MissionCases> missions = study_missions(study, false);
  engine.piece = [evaluator, cases, missions, design_at, purpose](const Piece& piece) {
    const Scene design = design_at(piece.x);
    if (const std::size_t loads = std::max<std::size_t>(cases.size(), 1); piece.load >= loads)
      return mission_piece(*evaluator, optimizer::mission_loads(design, cases, missions.at(piece.load - loads)), piece);
    const Scene scene = cases.empty() ? design : optimizer::in_case(design, cases.at(piece.load));
    if (piece.what == Piece::What::finer)
      return optimizer::evaluated_finer(*evaluator, scene, purpose, piece.number).evaluation;
    if (piece.what == Piece::What::departed) {
      const optimizer::LoadCase& departure = optimizer::usual_departures()[static_cast<std::size_t>(piece.number)];
      return evaluated(*evaluator, optimizer::in_case(scene, departure), purpose).evaluation;
    }
    optimizer::Purpose asked = purpose;
    asked.bars = asked.history = piece.what == Piece::What::barred;
    return evaluator->evaluate(scene, asked).evaluation;
  };
  engine.rules = [design_at, cases](std::span<const double> x) { return rules_in_cases(design_at(x), cases); };
  const auto whole = [piece = engine.piece, cases, missions, design_at](Piece::What what, std::span<const double> x,
                                                                        int number) {
    Piece one{.what = what, .x = {x.begin(), x.end()}, .load = 0, .number = number};
    const auto at = [&](const auto&, std::size_t load) {
      one.load = load;
      return piece(one);
    };
    return optimizer::evaluated_in_cases(cases, design_at(x), at, missions, at);
  };
  engine.evaluate = [whole](std::span<const double> x) { return whole(Piece::What::evaluate, x, 0); };
  engine.finer = [whole](std::span<const double> x, int level) { return whole(Piece::What::finer, x, level); };
  engine.barred = [whole](std::span<const double> x) { return whole(Piece::What::barred, x, 0); };
  engine.departed = [whole](std::span<const double> x, int number) { return whole(Piece::What::departed, x, number); };
  engine.start = [evaluator, scene = optimizer::in_first_case(start_scene(study), cases), purpose] {
    optimizer::Purpose with_bars = purpose;
    with_bars.bars = true;
    return evaluator->evaluate(scene, with_bars).evaluation;
  };
  // Of what wears, all of it is shown.
  const bool wears = purpose.until >= optimizer::Stage::worn_state;
  const auto closer = std::make_shared<CloserLook>(evaluator, wears ? optimizer::Stage::worn_resonance : purpose.until);
  const std::vector<optimizer::MissionCases> shown =
      wears ? study_missions(study, true) : std::vector<optimizer::MissionCases>();
  engine.describe = [closer, cases, shown](const Scene& design) {
    const Scene first = optimizer::in_first_case(design, cases);
    const auto result = closer->take(first);
    return DescribedDesign{
        .evaluation = optimizer::evaluated_in_cases(
            cases, design, [&](const Scene& scene, std::size_t) { return closer->evaluation(scene); }, shown,
            [&](const optimizer::MissionCases& mission, std::size_t) {
              return closer->evaluator().evaluate_mission(optimizer::mission_loads(design, cases, mission));
            }),
        .record = report::make_design_record(first, *result)};
  };
  if (!wears) return engine;
  engine.verify = [closer](const Scene& scene, const optimizer::FinerDesign* given, const wear::Watcher& watcher) {
    const optimizer::FinerDesign there =
        given != nullptr ? *given : optimizer::twice_as_fine(closer->evaluator(), scene);
    const std::shared_ptr<const optimizer::CandidateResult> design = closer->look(scene);
    return report::make_verification_record(optimizer::verify(scene, *design, there, {}, watcher), design->model);
  };
  return engine;
}

optimizer::Cost expected_cost(const Study& study) {
  try {
    const Scene scene = optimizer::in_first_case(study.scene, study.problem.cases);
    optimizer::Cost cost = optimizer::cost_foreseen(optimizer::sizes_foreseen(reference_scene(study), scene));
    cost.seconds *= optimizer::loads_foreseen(study.problem.cases, study.scene.solver.prestress);
    return cost;
  } catch (const InputError&) {
    return {};
  }
}

report::DesignRecord describe_fields(const Study& study, bool history) {
  report::DesignRecordOptions options{.curve_points = 0, .nodal_diameter_modes = 0, .history_profiles = 16};
  if (!history) options.history_steps = 0;
  const Scene scene = optimizer::in_first_case(study.scene, study.problem.cases);
  return report::make_design_record(scene, scene_evaluator(study)->evaluate(scene, {.bars = false}), options);
}

std::vector<geometry::Rule> rules_in_cases(const Scene& design, const std::vector<optimizer::LoadCase>& cases) {
  if (cases.empty()) return optimizer::feasibility_of(design).rules;
  std::vector<geometry::Rule> all;
  for (const optimizer::LoadCase& load : cases)
    for (geometry::Rule& rule : optimizer::feasibility_of(optimizer::in_case(design, load)).rules) {
      rule.name = optimizer::of_case(rule.name, load.name);
      rule.sentence = "in case " + load.name + " " + rule.sentence;
      all.push_back(std::move(rule));
    }
  return all;
}

std::vector<std::string> broken_rules(const Scene& scene) {
  std::vector<std::string> sentences;
  for (const geometry::Rule& rule : optimizer::feasibility_of(scene).rules)
    if (rule.margin < 0) sentences.push_back(rule.sentence);
  return sentences;
}

InputError infeasible(const std::string& file, const std::vector<std::string>& messages) {
  std::vector<Violation> found;
  for (const std::string& message : messages)
    found.push_back({.file = file, .key = "the design is infeasible", .value = {}, .allowed = message});
  if (found.empty()) found.push_back({.file = {}, .key = file, .value = {}, .allowed = "the design is infeasible"});
  return InputError(std::move(found));
}

}  // namespace dovetail::studies
