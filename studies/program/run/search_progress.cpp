#include "studies/program/run/search_progress.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <utility>

#include "studies/program/engine/json_values.hpp"
#include "studies/report/words/report_words.hpp"

namespace dovetail::studies {

std::string broken_words(const optimizer::Problem& problem, const optimizer::Evaluation& evaluation,
                         const std::vector<double>& constraints) {
  if (evaluation.infeasible()) return fmt::format("{}", fmt::join(evaluation.messages, "; "));
  const std::vector<std::string> names = optimizer::constraint_names(problem);
  std::vector<std::string> broken;
  for (std::size_t j = 0; j < std::min(names.size(), constraints.size()); ++j)
    if (constraints[j] > 0)
      broken.push_back(fmt::format("{} by {:.3g} % of its limit", names[j], 100 * constraints[j]));
  return broken.empty() ? "" : fmt::format("breaks {}", fmt::join(broken, ", "));
}

SearchProgress::SearchProgress(Teller& teller, const optimizer::Problem& problem, int evaluations,
                               std::string directory, bool at_once)
    : teller_(teller),
      problem_(problem),
      evaluations_(evaluations),
      directory_(std::move(directory)),
      at_once_(at_once) {}

void SearchProgress::operator()(const optimizer::Progress& progress) {
  const optimizer::Candidate& candidate = progress.candidate;
  if (!candidate.replayed) ++computed_;
  feasible_ += candidate.evaluation.feasible ? 1 : 0;
  if (progress.best == progress.index) {
    best_ = candidate.judgement.objective;
    has_best_ = true;
  }
  const int done = static_cast<int>(progress.index) + 1;
  teller_.keeps(fmt::format("{} kept in {}; the same command with --resume goes on",
                            report::counted(progress.index + 1, "evaluation"), directory_));
  const auto words = [text = standing(progress), begin = begin_, computed = computed_,
                      left = evaluations_ - done](double) {
    const double seconds = std::chrono::duration<double>(Clock::now() - begin).count();
    std::string line = fmt::format("{}; {:.0f} s", text, seconds);
    if (computed > 0 && left > 0) line += fmt::format(", about {:.0f} s to go", std::ceil(seconds / computed * left));
    return line;
  };
  teller_.status(words, at_once_              ? "the evaluations under way"
                        : done < evaluations_ ? fmt::format("evaluation {}", done + 1)
                                              : std::string("what is under way"));
  Json event{{"number", done},
             {"of", evaluations_},
             {"status", candidate.evaluation.status},
             {"feasible", candidate.evaluation.feasible},
             {"objective", json_of(candidate.judgement.objective)},
             {"stored", candidate.replayed}};
  if (has_best_) event["best_objective"] = json_of(best_);
  teller_.event("evaluation", event);
}

std::string SearchProgress::standing(const optimizer::Progress& progress) const {
  const optimizer::Candidate& candidate = progress.candidate;
  std::string here = "not computed";
  if (candidate.judgement.computed)
    here = problem_.front ? fmt::format("{:.4g}", fmt::join(candidate.judgement.terms, ", "))
                          : fmt::format("{:.4g}", candidate.judgement.objective);
  else if (!candidate.evaluation.converged())
    here = candidate.evaluation.status;
  if (const std::string broken = broken_words(problem_, candidate.evaluation, candidate.judgement.constraints);
      !broken.empty())
    here += (candidate.judgement.computed ? ", infeasible: " : ": ") + broken;
  if (!problem_.front && has_best_ && candidate.evaluation.feasible && candidate.judgement.objective < best_)
    here += ", refused by a limit as finer meshes have it";
  const std::string best = problem_.front ? fmt::format("{} feasible", feasible_)
                           : has_best_    ? fmt::format("best {:.4g} (feasible)", best_)
                                          : std::string("best none feasible yet");
  return fmt::format("evaluation {}/{}{}: {}; {}", progress.index + 1, evaluations_,
                     candidate.replayed ? " (stored)" : "", here, best);
}

}  // namespace dovetail::studies
