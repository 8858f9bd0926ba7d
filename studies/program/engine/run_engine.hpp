#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <string_view>
#include <vector>

#include "core/enum_names.hpp"
#include "geometry/rules/feasibility.hpp"
#include "optimizer/departures.hpp"
#include "optimizer/problem/evaluation.hpp"
#include "optimizer/scene/scene.hpp"
#include "optimizer/search/run.hpp"
#include "optimizer/verification.hpp"
#include "studies/program/study_file/study.hpp"
#include "studies/report/record/run_record.hpp"
#include "wear/watcher.hpp"

namespace dovetail::studies {

/// A design looked at more closely than a search does.
struct DescribedDesign {
  optimizer::Evaluation evaluation;
  report::DesignRecord record;
};

/// A part of the work of a run that others can do by themselves: a design in one case, or in all of them that act in
/// turn.
struct Piece {
  enum class What {
    evaluate,  ///< as a candidate
    finer,     ///< the same on a finer mesh, `number` levels
    barred,    ///< as a candidate, with bars and what a wear history decides
    departed,  ///< where something is other than the study says: the departure of that number
    verify,    ///< by its wear history and at finer settings
  };
  What what = What::evaluate;
  std::vector<double> x;  ///< of the variables, in the unit of the file
  std::size_t load = 0;   ///< place of the case, 0 without cases; after them those of the missions
  int number = 0;
};
constexpr EnumNames<Piece::What, 5> enum_names(Piece::What) {
  return {{{Piece::What::evaluate, "evaluate"},
           {Piece::What::finer, "finer"},
           {Piece::What::barred, "barred"},
           {Piece::What::departed, "departed"},
           {Piece::What::verify, "verify"}}};
}
[[nodiscard]] constexpr std::string_view to_string(Piece::What what) {
  return name_of(what);
}

/// A design, and the number of a departure that it meets.
struct Departed {
  std::vector<double> x;
  int departure = 0;
};

/// What a run computes with.
struct RunEngine {
  optimizer::Evaluator evaluate;  ///< design variables in, evaluation out
  /// The study's own design with bars, in its first case, as far as a candidate is computed; empty: there are none.
  std::function<optimizer::Evaluation()> start = {};
  /// The same on finer meshes; empty: limits are kept on one mesh.
  optimizer::FinerEvaluator finer = {};
  /// The design with bars and what the wear history decides, as far as the study's responses need, and with the curves
  /// and fields, of its first case, that results and report show; empty: they show none. Threads may ask at once.
  std::function<DescribedDesign(const optimizer::Scene&)> describe;
  /// The design's wear by the full history, at settings that are handed over or, without them, at finer ones; empty:
  /// designs are not verified.
  std::function<report::VerificationRecord(const optimizer::Scene&, const optimizer::FinerDesign*,
                                           const wear::Watcher&)>
      verify = {};
  /// The design where something is other than the study says, as a candidate is computed; empty: nobody asks.
  std::function<optimizer::Evaluation(std::span<const double> x, int departure)> departed = {};
  /// The design as a candidate, with bars and what a wear history decides; empty: there are none.
  optimizer::Evaluator barred = {};
  /// Any piece but a verification; empty: candidates are evaluated whole.
  std::function<optimizer::Evaluation(const Piece&)> piece = {};
  /// The geometric rules of a design, kept or not; empty: there are none.
  std::function<std::vector<geometry::Rule>(std::span<const double> x)> rules = {};
  /// Of many designs at once, see BatchEvaluator; empty: one after the other.
  optimizer::BatchEvaluator many = {};
  optimizer::BatchEvaluator barred_at_once = {};
  std::function<void(const std::vector<Departed>&, const std::function<bool(std::size_t, optimizer::Evaluation)>& told)>
      departed_at_once = {};
};

/// Makes the engine of a study.
using RunEngineFactory = std::function<RunEngine(const Study&)>;

/// The physics.
[[nodiscard]] RunEngine study_engine(const Study& study);

}  // namespace dovetail::studies
