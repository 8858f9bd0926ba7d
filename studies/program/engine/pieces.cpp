#include "studies/program/engine/pieces.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <numeric>
#include <utility>

#include "optimizer/cases.hpp"
#include "optimizer/journal/evaluation_json.hpp"
#include "studies/program/engine/engine.hpp"
#include "studies/program/engine/json_values.hpp"
#include "studies/report/record/record_tables.hpp"

namespace dovetail::studies {

namespace {

using optimizer::Evaluation;
using optimizer::Finished;
using optimizer::NotFinite;

template <class T>
Json exact(const T& value) {
  return optimizer::json_value<Json>(value, NotFinite::text);
}

std::string line(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

/// A study with its text, and the numbers of its scene that are not as the text has them: settings may be chosen.
Json study_json(const Study& study) {
  return {{"file", study.file},
          {"text", study.text},
          {"numbers", exact(optimizer::parameters(study.scene))},
          {"noise", study.optimizer.noise}};
}

Study study_of(const Json& json) {
  Study study = read_study(parse_document(json.at("text").get<std::string>(), json.at("file").get<std::string>()));
  std::map<std::string, double> numbers;
  optimizer::read_json(json.at("numbers"), numbers);
  const std::map<std::string, double> own = optimizer::parameters(study.scene);
  for (const auto& [key, value] : numbers)
    if (const auto found = own.find(key); found == own.end() || found->second != value)
      optimizer::set_parameter(study.scene, key, value);
  study.optimizer.noise = json.at("noise").get<double>();
  return study;
}

Piece piece_of(const Json& json) {
  return {.what = named<Piece::What>(json.at("what").get<std::string>()).value(),
          .x = json.at("x").get<std::vector<double>>(),
          .load = json.at("case").get<std::size_t>(),
          .number = json.at("number").get<int>()};
}

std::string task_of(const Piece& piece) {
  return line(
      {{"what", std::string(to_string(piece.what))}, {"x", piece.x}, {"case", piece.load}, {"number", piece.number}});
}

optimizer::Scene scene_of(const Study& study, const std::vector<double>& x, std::size_t load) {
  const optimizer::Scene scene = scene_at(study, x);
  return study.problem.cases.empty() ? scene : optimizer::in_case(scene, study.problem.cases.at(load));
}

/// What a worker lost: the command that computes it again.
Evaluation lost(const Study& study, const Piece& piece, const std::string& ended) {
  Evaluation evaluation;
  evaluation.status = optimizer::failed_at(optimizer::kWorkerStage, ended);
  std::string command = "dovetail evaluate " + study.file + " --no-bars --no-history";
  const auto set = [&](const std::string& key, double value) { command += " --set " + key + "=" + shortest(value); };
  for (const auto& [key, value] : study.problem.space.settings(piece.x)) set(key, value);
  if (piece.load < study.problem.cases.size())  // else it is of all cases together
    for (const auto& [key, value, times] : study.problem.cases.at(piece.load).changes)
      set(key, optimizer::parameter(scene_of(study, piece.x, piece.load), key));
  evaluation.messages.push_back("The process that computed it " + ended + "; the same again: " + command);
  return evaluation;
}

Evaluation evaluation_of(const Study& study, const Piece& piece, const Finished& finished) {
  if (!finished.answer) return lost(study, piece, finished.ended);
  Evaluation evaluation;
  optimizer::read_json(Json::parse(*finished.answer), evaluation);
  return evaluation;
}

/// Pieces of many designs, all cases and missions of each; tells of a design when its last case is there. Of each the
/// case stays open.
void run_designs(const Study& study, const std::vector<Piece>& designs, optimizer::WorkerPool& pool,
                 const std::function<bool(std::size_t, Evaluation)>& told) {
  const std::vector<optimizer::LoadCase>& cases = study.problem.cases;
  const std::vector<optimizer::MissionCases> missions = study_missions(study, false);
  const std::size_t alone = std::max<std::size_t>(cases.size(), 1), loads = alone + missions.size();
  // The longest first, so that none is waited for alone: a mission takes more than any of its cases. Then those that
  // share most one after the other, for a worker keeps what the last ones shared.
  std::vector<std::size_t> order(missions.size());
  std::iota(order.begin(), order.end(), alone);
  std::ranges::copy(cases.empty() ? std::vector<std::size_t>{0} : optimizer::by_what_they_share(cases),
                    std::back_inserter(order));
  std::vector<Piece> pieces;
  std::vector<std::string> tasks;
  for (Piece piece : designs)
    for (const std::size_t load : order) {
      piece.load = load;
      pieces.push_back(piece);
      tasks.push_back(task_of(piece));
    }
  std::vector<std::vector<Evaluation>> found(designs.size(), std::vector<Evaluation>(loads));
  std::vector<std::size_t> left(designs.size(), loads);
  pool.run(tasks, [&](const Finished& finished) {
    const std::size_t design = finished.task / loads;
    found[design][pieces[finished.task].load] = evaluation_of(study, pieces[finished.task], finished);
    if (--left[design] > 0) return true;
    return told(design, optimizer::together(cases, scene_at(study, designs[design].x), found[design], missions));
  });
}

std::vector<double> list(std::span<const double> x) {
  return {x.begin(), x.end()};
}

Evaluation run_design(const Study& study, Piece::What what, std::span<const double> x, int number,
                      optimizer::WorkerPool& pool) {
  Evaluation result;
  run_designs(study, {{.what = what, .x = list(x), .load = 0, .number = number}}, pool,
              [&](std::size_t, Evaluation evaluation) {
                result = std::move(evaluation);
                return true;
              });
  return result;
}

}  // namespace

std::string description_of(const Study& study, const Study* finer) {
  Json json{{"study", study_json(study)}};
  if (finer != nullptr) json["finer"] = study_json(*finer);
  return line(json);
}

optimizer::WorkerFactory workers_with(const RunEngineFactory& make_engine) {
  return [make_engine](const std::string& common) -> optimizer::Worker {
    const Json json = Json::parse(common);
    const auto study = std::make_shared<const Study>(study_of(json.at("study")));
    const auto finer =
        json.contains("finer") ? std::make_shared<const Study>(study_of(json.at("finer"))) : std::shared_ptr<Study>();
    return [study, finer, engine = make_engine(*study)](const std::string& task) -> std::string {
      const Piece piece = piece_of(Json::parse(task));
      if (piece.what != Piece::What::verify)
        return line(exact(optimizer::evaluated_or_refused(
            [&] { return engine.piece ? engine.piece(piece) : engine.evaluate(piece.x); })));
      optimizer::FinerDesign there;
      if (finer) there = {.scene = scene_of(*finer, piece.x, piece.load), .reference = reference_scene(*finer)};
      return line(exact(engine.verify(scene_of(*study, piece.x, piece.load), finer ? &there : nullptr, {})));
    };
  };
}

RunEngine at_work(const Study& study, const RunEngine& engine, optimizer::WorkerPool& pool) {
  RunEngine result = engine;
  result.evaluate = [&study, &pool](std::span<const double> x) {
    return run_design(study, Piece::What::evaluate, x, 0, pool);
  };
  if (engine.finer)
    result.finer = [&study, &pool](std::span<const double> x, int level) {
      return run_design(study, Piece::What::finer, x, level, pool);
    };
  const auto many = [&study, &pool](Piece::What what) -> optimizer::BatchEvaluator {
    return [&study, &pool, what](const std::vector<std::vector<double>>& points,
                                 const std::function<bool(std::size_t, Evaluation)>& told) {
      std::vector<Piece> designs;
      for (const std::vector<double>& x : points) designs.push_back({.what = what, .x = x, .load = 0, .number = 0});
      run_designs(study, designs, pool, told);
    };
  };
  result.many = many(Piece::What::evaluate);
  if (engine.barred) result.barred_at_once = many(Piece::What::barred);
  if (engine.departed)
    result.departed_at_once = [&study, &pool](const std::vector<Departed>& designs,
                                              const std::function<bool(std::size_t, Evaluation)>& told) {
      std::vector<Piece> pieces;
      for (const auto& [x, departure] : designs)
        pieces.push_back({.what = Piece::What::departed, .x = x, .load = 0, .number = departure});
      run_designs(study, pieces, pool, told);
    };
  return result;
}

void verify_at_once(std::span<const Verified> wanted, optimizer::WorkerPool& pool,
                    const std::function<bool(std::size_t, report::VerificationRecord)>& told) {
  std::vector<std::string> tasks;
  for (const Verified& one : wanted)
    tasks.push_back(task_of({.what = Piece::What::verify, .x = one.x, .load = one.load, .number = 0}));
  pool.run(tasks, [&](const Finished& finished) {
    report::VerificationRecord record;
    if (finished.answer)
      optimizer::read_json(Json::parse(*finished.answer), record);
    else
      record.status = optimizer::failed_at(optimizer::kWorkerStage, finished.ended);
    return told(finished.task, std::move(record));
  });
}

}  // namespace dovetail::studies
